// What this process spent, and what others took from it meanwhile: to time work on a machine that is shared.
#pragma once

namespace triptych {

/// Milliseconds since some moment in the past: differences mean something.
struct SpentTime {
  double wall_ms = 0;  ///< steady clock
  double cpu_ms = 0;   ///< processor time of all threads of this process
  /// Threads of this process were ready to run while other threads had their cores, summed over threads
  /// (Linux: the second number of schedstat; sched-stats.rst). 0 where the kernel does not tell.
  double waiting_ms = 0;
  /// The hypervisor ran something else while a core of this machine had work, summed over cores (`steal` of
  /// /proc/stat); counted in ticks of 10 ms as a rule.
  double stolen_ms = 0;
  /// Not a sum: how many threads of the machine run, or wait for a core, at this moment; this one included.
  double runnable = 1;
};

/// Processor time of all threads of this process so far, milliseconds: SpentTime::cpu_ms alone, without
/// files.
double process_cpu_milliseconds();

/// What was spent up to now. Reads files of /proc, which takes some ten microseconds and two for each thread.
SpentTime spent_time();

/// Wall and processor time of one stage of a frame, from here on: without files, for what is measured often.
class StageWatch {
 public:
  StageWatch();
  /// The other members are left 0.
  SpentTime spent() const;

 private:
  SpentTime began_;
};

/// What was spent from `before` to `after`, `runnable` left out. Never negative: a thread that has ended
/// takes its waiting along.
SpentTime operator-(const SpentTime& after, const SpentTime& before);

/// Whether the wall time between the two is that of a quiet machine: nothing was stolen, this process's
/// threads waited for cores for at most 2 % of it, and at its ends there was a core for each thread that ran.
/// A thread that never got a core in between is not known to have waited; that is what the ends are for.
bool is_undisturbed(const SpentTime& before, const SpentTime& after);

}  // namespace triptych
