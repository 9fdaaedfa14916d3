// What the shared libraries show: all else in them is hidden (docs/install.md).
#pragma once

/// Before the name of a namespace: what is declared in it is part of the public API. As a standard
/// attribute, which Clang 14 takes there, too.
#define NAVJIT_API [[gnu::visibility("default")]]
