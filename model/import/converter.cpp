#include "model/import/converter.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/one_line.hpp"
#include "base/process.hpp"
#include "base/progress.hpp"
#include "base/unnamed_file.hpp"
#include "model/import/import_reader.hpp"
#include "model/import/mesh_stream_source.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace triptych {

namespace {

constexpr std::string_view complaint_prefix = "triptych: ", warning_prefix = "warning: ",
                           progress_prefix = "progress: ", reads_prefix = "reads: ";
constexpr size_t max_line = 4096, max_warnings = 200,
                 max_files = 10000;  ///< of its output; what is beyond is not kept

/// A child process that is killed and collected when it goes out of scope.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  ~Child() {
    if (!running_) return;
    ::kill(pid_, SIGKILL);
    while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Its status when it has ended; nullopt if it is still running after so many seconds.
  std::optional<int> wait(double seconds) {
    const Stopwatch stopwatch;
    int status = 0;
    for (;;) {
      const pid_t ended = ::waitpid(pid_, &status, WNOHANG);
      if (ended == pid_) {
        running_ = false;
        return status;
      }
      if (stopwatch.seconds() > seconds) return std::nullopt;
      ::usleep(1000);
    }
  }

 private:
  pid_t pid_;
  bool running_ = true;
};

std::filesystem::path beside_this_program(const std::string& name) {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / name;
}

/// The bytes in a file without a name.
Descriptor as_file(const std::shared_ptr<const StreamSource>& source, const ImportOptions& options) {
  Descriptor file = open_unnamed_file(options.temporary_folder);
  SourceReader reader(source);
  std::vector<std::byte> block(size_t{1} << 20);
  for (uint64_t offset = 0; offset < source->size();) {
    const auto count = static_cast<size_t>(std::min<uint64_t>(block.size(), source->size() - offset));
    reader.read(offset, std::span(block).first(count));
    write_all(file.number(), std::span(block).first(count), source->name());
    offset += count;
  }
  return file;
}

/// The child's message, which a damaged file may have caused, as one line of printable characters.
std::string plain(std::string_view line) { return one_line(std::string(line.substr(0, 200))); }

/// Last words of Node where the kernel gives it no memory.
bool is_of_memory(std::string_view line) {
  constexpr std::array<std::string_view, 5> words = {"out of memory", "bad_alloc", "SetPermissions",
                                                     "process OOM", "uv_thread_create"};
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return line.find(word) != std::string_view::npos; });
}

constexpr const char* needs_memory = "needs more memory to read than it is given";

/// The complaint, and what else its reader may lack than memory.
std::string explained(const std::string& complaint) {
  rlimit limit{};
  const bool limited = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  if (complaint != needs_memory || !limited) return complaint;
  return complaint + ": address space is limited (ulimit -v), of which a reader reserves more than it uses";
}

/// What the child prints on its standard error, line by line.
class Talk {
 public:
  explicit Talk(const std::filesystem::path& file) : stage_("reading " + file.filename().string()) {}

  /// Listens until the child closes its end, or says nothing about its progress for so many seconds: false.
  bool listen(int errors, double seconds) {
    Stopwatch since_progress;
    while (since_progress.seconds() < seconds) {
      pollfd waiting{.fd = errors, .events = POLLIN, .revents = 0};
      const double left = std::clamp(seconds - since_progress.seconds(), 0.0, 1.0);
      if (::poll(&waiting, 1, static_cast<int>(left * 1000) + 1) <= 0) continue;
      std::array<char, 4096> buffer{};
      const ssize_t count = ::read(errors, buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        take(line_);
        return true;
      }
      for (const char letter : std::string_view(buffer.data(), static_cast<size_t>(count))) {
        if (letter != '\n') {
          if (line_.size() < max_line) line_ += letter;
        } else {
          if (take(line_)) since_progress = Stopwatch();
          line_.clear();
        }
      }
    }
    return false;
  }

  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> also_read;
  std::string complaint;

 private:
  /// Whether the line says that the child has come further.
  bool take(std::string_view line) {
    if (line.starts_with(progress_prefix)) return advance(line.substr(progress_prefix.size()));
    if (line.starts_with(warning_prefix) && warnings.size() < max_warnings) {
      warnings.push_back(plain(line.substr(warning_prefix.size())));
    } else if (line.starts_with(reads_prefix)) {
      // What a damaged file made it print may be no file.
      const std::filesystem::path file = line.substr(reads_prefix.size());
      std::error_code error;
      if (also_read.size() < max_files && std::filesystem::is_regular_file(file, error))
        also_read.push_back(file);
    } else if (line.starts_with(complaint_prefix)) {
      complaint = plain(line.substr(complaint_prefix.size()));
    } else if (complaint.empty() && is_of_memory(line)) {
      complaint = needs_memory;
    }
    return false;
  }

  bool advance(std::string_view numbers) {
    const auto done = to_integer(take_word(numbers)), total = to_integer(take_word(numbers));
    if (!done || !total || *done <= done_ || *done > *total) return false;
    if (!progress_) progress_.emplace(stage_, static_cast<uint64_t>(*total));
    progress_->advance(static_cast<uint64_t>(*done - done_));
    done_ = *done;
    return true;
  }

  std::string stage_, line_;
  std::optional<Progress> progress_;
  int64_t done_ = 0;
};

}  // namespace

Converted convert_model(const std::filesystem::path& file, const PackedFile* unpacked,
                        const ImportOptions& options, const Converter& converter) {
  const std::string place = file.string();
  StreamSource exists(file);  // Error if it does not
  const std::filesystem::path program =
      options.converter.empty() ? beside_this_program(converter.program) : options.converter;
  if (::access(program.c_str(), X_OK) != 0)
    fail(place, "is of a format that {} reads, which is not there", program.string());

  Descriptor output = open_unnamed_file(options.temporary_folder);
  Pipe errors = open_pipe(place);
  Descriptor input;
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), converter.flags.begin(), converter.flags.end());
  words.insert(words.end(), {"--memory", std::to_string(options.converter_bytes)});
  std::vector<Program::Handed> handed = {{output.number(), 3}, {errors.write.number(), STDERR_FILENO}};
  if (unpacked) {
    input = as_file(unpacked->content, options);
    words.insert(words.end(), {"--as", unpacked->name.extension().string(), "/proc/self/fd/4"});
    handed.push_back({input.number(), 4});
  } else {
    words.push_back(place);
  }
  const Program reader{.file = program.string(),
                       .words = std::move(words),
                       .descriptors = std::move(handed),
                       .death_signal = SIGKILL,
                       .default_signals = {},
                       .ignored_signals = {}};
  Child child(start_program(reader, program.string()));
  errors.write.close();
  Talk talk(file);
  const bool closed = talk.listen(errors.read.number(), options.converter_seconds);
  const auto ended = closed ? child.wait(options.converter_seconds) : std::nullopt;
  if (!ended) fail(place, "takes more than {} s to read; it was given up", options.converter_seconds);
  const int status = *ended;
  if (WIFSIGNALED(status)) {
    if (!talk.complaint.empty()) fail(place, "{}", explained(talk.complaint));
    fail(place, "makes its reader crash (signal {}, {}); the file is damaged, or {} cannot read it",
         WTERMSIG(status), ::strsignal(WTERMSIG(status)), converter.library);
  }
  if (WEXITSTATUS(status) != 0) {
    if (!talk.complaint.empty()) fail(place, "{}", explained(talk.complaint));
    fail(place, "its reader ended with exit code {}; the file is damaged, or {} cannot read it",
         WEXITSTATUS(status), converter.library);
  }
  return {std::make_shared<StreamSource>(place, std::move(output)), std::move(talk.warnings),
          std::move(talk.also_read)};
}

}  // namespace triptych
