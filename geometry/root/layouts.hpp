// What classes consist of, as the file itself describes it by ROOT's StreamerInfos.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/root/container.hpp"

namespace navjit::root {

/// The types of members that are read; the numbers are ROOT's.
enum MemberType : std::uint32_t {
  base = 0,
  basic = 1,       ///< 1 to 19: numbers
  basic_end = 20,  ///< 21 to 39: arrays of a fixed length
  counted = 40,    ///< 41 to 59: arrays whose length is in another member
  counted_end = 60,
  text_pointer = 7,       ///< char*
  embedded = 61,          ///< an object of a class of ROOT
  embedded_any = 62,      ///< or of another class
  embedded_pointer = 63,  ///< a pointer that is never null; the object stands in its place
  pointer = 64,
  text = 65,
  root_object = 66,
  named = 67,
  embedded_pointer_any = 68,
  pointer_any = 69,
};

/// A base or member of a class.
struct Member {
  std::string name, counter;
  std::uint32_t type = 0;
  std::uint32_t length = 0;  ///< of an array of fixed length
  std::string content{};     ///< the class of a std::vector's elements
};
using Layout = std::vector<Member>;

/// The layouts of all classes of a file, by name and version.
class Layouts {
 public:
  /// Reads the layouts of a file. Throws FormatError.
  explicit Layouts(Container& file);

  /// Null if the file has none of the class. For a version that is missing, the newest.
  const Layout* find(std::string_view type, int version) const;

 private:
  std::map<std::string, std::map<int, Layout>, std::less<>> layouts_;
};

}  // namespace navjit::root
