// What a program that reads hostile files with a large library may take.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace triptych {

/// Leaves no core file, and takes no more address space than this: an allocation beyond it ends the program
/// with exit code 1 and one line. Error (program) if that cannot be set. Off under the address sanitizer.
void limit_address_space(uint64_t bytes, std::string_view program);

/// The same for memory that can be written to, of a program that reserves more addresses than it uses; what
/// happens beyond it is the program's affair.
void limit_data(uint64_t bytes, std::string_view program);

/// "triptych: needs more memory ..." and exit code 1, without an allocation.
[[noreturn]] void end_out_of_memory();

/// The values of flags before the last argument, by name; nullopt for another form, a flag that is not among
/// the known or is there twice, or without --memory.
std::optional<std::map<std::string, std::string>> reader_flags(int count, const char* const* arguments,
                                                               const std::set<std::string>& known);

/// The number behind --memory. Error for anything else.
uint64_t memory_argument(std::string_view text);

}  // namespace triptych
