// Rays: read from files, or made up.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/part.hpp"
#include "geometry/model/world.hpp"
#include "geometry/rays/ray_maker.hpp"
#include "runtime/transport.hpp"

struct gzFile_s;

namespace navjit::common {

/// A file of rays, read one by one: `x,y,z,dx,dy,dz` (mm; header required; blanks around values and
/// a byte order mark are passed over; plain or gzip); directions are normalised. Throws Error with
/// file and line on anything else, and on a file without rays.
class RayFile {
 public:
  explicit RayFile(std::string path);

  /// The next ray; none at the end.
  std::optional<Ray> next();

 private:
  struct Close {
    void operator()(gzFile_s* file) const;
  };
  bool read_line(std::string_view& row);
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  std::unique_ptr<gzFile_s, Close> file_;
  char text_[1024];
  std::uint64_t line_ = 0, rays_ = 0;
};

/// All rays of a file. Throws as RayFile.
std::vector<Ray> read_rays(const std::string& path);

using navjit::RayMaker;
using navjit::RaySource;

/// The rays of a file, or so many of a source where `text` is a number, as they are needed.
class RayStream {
 public:
  /// The world has to outlive it. Throws as RayFile and RayMaker, and UsageError for a number that
  /// is no count. `part`: only these of the rays, with the numbers that they have in the whole; a
  /// file is read once before, to count its rays.
  RayStream(const std::string& text, const RaySource& source, const World& world,
            const Part& part = {});

  /// How many there are; 0 where that is not known, since they are a file's.
  std::uint64_t count() const { return count_; }
  /// At most so many; none at the end.
  std::vector<Ray> next(std::size_t most);

 private:
  std::optional<RayFile> file_;
  std::optional<RayMaker> maker_;
  std::uint64_t count_ = 0, made_ = 0, first_ = 0;
  bool counted_ = false;
};

/// All of them. Throws the same.
std::vector<Ray> rays_of(const std::string& text, const RaySource& source, const World& world);

/// Throws Error if all rays of a source would start outside the world: if it has an
/// origin, and that is not inside.
void check_origin(const RaySource& source, const std::shared_ptr<const World>& world);

}  // namespace navjit::common
