// ROOT's lists of objects.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "geometry/root/pointers.hpp"

namespace navjit::root {

/// The objects of a TObjArray, TList or THashList that begins at `at`; none for other classes.
/// `spend` is called with their number before memory is taken for them. Throws FormatError.
std::vector<Reference> list_at(const RecordBytes& record, std::string_view type, Bytes at,
                               const std::function<void(std::size_t)>& spend);

}  // namespace navjit::root
