// The objects of one record; each is read when it is asked for.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "geometry/root/layouts.hpp"
#include "geometry/root/pointers.hpp"

namespace navjit::root {

/// An object with those of its members that geometries are made of. Throws RootError if it lacks a
/// member that is asked for.
struct Object {
  using Value = std::variant<double, std::vector<double>, Reference>;

  std::string type;  ///< its class
  std::string name{};
  std::uint32_t bits = 0;  ///< TObject's
  std::vector<std::pair<std::string_view, Value>> members{};

  bool is(std::string_view wanted) const { return type == wanted; }
  double number(std::string_view member) const;
  double number(std::string_view member, double fallback) const;
  /// A member that is a count: a whole number of at most `most`.
  std::size_t count(std::string_view member, std::size_t most) const;
  /// A member with at least so many numbers, all of them finite.
  std::span<const double> numbers(std::string_view member, std::size_t least) const;
  /// The member; 0 if there is none.
  Reference reference(std::string_view member) const;
  /// For messages: "TGeoTube 'pipe'".
  std::string label() const;
  /// Throws a RootError: the label and the problem.
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  const Value* find(std::string_view member) const;
};

/// All objects of a record. All functions throw FormatError.
class Objects {
 public:
  Objects(std::string bytes, const Key& key, const Layouts& layouts);

  /// The object that a pointer names; the same one each time.
  const Object& at(Reference reference);
  /// The same for an object that is asked for only once; it is not kept.
  Object read(Reference reference);
  /// The objects of a list; none for 0.
  std::vector<Reference> list(Reference reference);

 private:
  /// Lengths of arrays, by the members that hold them, which stand before the arrays.
  using Counters = std::vector<std::pair<std::string_view, std::uint32_t>>;
  void read_class(Bytes& at, std::string_view type, Object& into, Counters& counters, int depth);
  bool read_member(Bytes& at, const Member& member, const Counters& counters, Object& into);
  bool read_vector(Bytes& at, const Member& member, Object& into);
  void spend(std::size_t amount);

  std::string bytes_;
  RecordBytes record_;
  std::string own_type_;
  const Layouts& layouts_;
  std::size_t budget_;
  std::unordered_map<Reference, std::unique_ptr<const Object>> known_;
};

}  // namespace navjit::root
