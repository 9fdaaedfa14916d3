// Turns what navjit throws into an exception of Geant4.
#pragma once

#include <G4Exception.hh>
#include <G4ExceptionSeverity.hh>

#include "navjit/errors.hpp"

namespace navjit::geant4 {

/// Returns what the call gives, or `fallback` if navjit does not accept its numbers (not finite, or
/// no direction). Geant4 then aborts the event.
template <typename Call, typename Answer>
Answer guarded(const char* name, const Call& call, Answer fallback) {
  try {
    return call();
  } catch (const Error& error) {
    G4Exception(name, "navjit0003", EventMustBeAborted, error.what());
    return fallback;
  }
}

}  // namespace navjit::geant4
