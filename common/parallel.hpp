// Work on several threads, of which some may not start and some may throw.
#pragma once

#include <atomic>
#include <functional>

namespace navjit::common {

/// Calls `work` on so many threads, this one included, and waits for them. Throws the first
/// exception that `work` threw, or Error if the system gives no more threads; in both
/// cases `stop` is set, which `work` has to look at, and all threads have ended.
void in_parallel(unsigned threads, std::atomic<bool>& stop, const std::function<void()>& work);

}  // namespace navjit::common
