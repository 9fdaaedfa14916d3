// What the shared libraries export; everything else in them is hidden (docs/install.md).
#pragma once

/// Stands before the name of a namespace: what is declared there is part of the public API. It is
/// written as a standard attribute, since Clang 14 accepts that form in this place, too.
#define NAVJIT_API [[gnu::visibility("default")]]
