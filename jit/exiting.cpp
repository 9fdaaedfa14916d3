#include "jit/exiting.hpp"

#include <dlfcn.h>
#include <unwind.h>

#include <string_view>

namespace navjit::jit {
namespace {

/// exit() is a few calls above the destructors that it calls.
struct Search {
  int calls_left = 100;
  bool found = false;
};

_Unwind_Reason_Code look_at(_Unwind_Context* call, void* search) {
  auto& s = *static_cast<Search*>(search);
  // The address where the call goes on. Nothing returns into exit(), so that this may be behind its
  // end, and one less is not.
  const auto next = _Unwind_GetIP(call);
  Dl_info in{};
  // By the name: where a program is not position-independent, what it takes for the address of a
  // function of a library is another.
  s.found = next != 0 && dladdr(reinterpret_cast<void*>(next - 1), &in) != 0 &&
            in.dli_sname != nullptr && std::string_view(in.dli_sname) == "exit";
  return s.found || --s.calls_left == 0 ? _URC_END_OF_STACK : _URC_NO_REASON;
}

}  // namespace

bool is_exiting() noexcept {
  Search search;
  _Unwind_Backtrace(look_at, &search);
  return search.found;
}

}  // namespace navjit::jit
