// Detectors, and what they are made of.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <navjit/detector.hpp>
#include <navjit/gdml.hpp>
#include <navjit/material.hpp>
#include <navjit/root.hpp>

#include <string>
#include <vector>

#include "python/core/arrays.hpp"

namespace navjit::python {
namespace {

// Handles: a detector and a number in it.

struct VolumeOf {
  Detector detector;
  VolumeId number;
  const LogicalVolume& operator*() const { return detector.volume(number); }
  const LogicalVolume* operator->() const { return &**this; }
};

struct MaterialOf {
  Detector detector;
  std::uint32_t number;
  const Material* operator->() const { return &detector.material(number); }
};

struct PlacementOf {
  Detector detector;
  VolumeId mother;
  std::size_t number;
  const Placement* operator->() const { return &detector.volume(mother).daughters[number]; }
};

/// A detector from a file, with what the reader had to say.
struct PythonDetector {
  Detector detector;
  GdmlReport report{};
};

/// Bytes of a file's name that are no UTF-8 are replaced: a str of it has to be.
py::str text(const std::string& name) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(name.data(), static_cast<py::ssize_t>(name.size()), "replace"));
}

const char* state_name(MaterialState state) {
  switch (state) {
    case MaterialState::solid:
      return "solid";
    case MaterialState::liquid:
      return "liquid";
    case MaterialState::gas:
      return "gas";
    case MaterialState::undefined:
      break;
  }
  return "undefined";
}

template <class Of>
bool same(const Of& a, const Of& b) {
  return a.detector.model() == b.detector.model() && a.number == b.number;
}

template <class Of>
std::size_t hash_of(const Of& a) {
  return std::hash<const void*>{}(a.detector.model().get()) ^ (a.number * 0x9e3779b97f4a7c15U);
}

py::array_t<double> vector(const double* v, std::vector<py::ssize_t> shape) {
  py::array_t<double> array(std::move(shape));
  std::copy(v, v + array.size(), array.mutable_data());
  return array;
}

/// (rotation, translation): local = rotation @ (outer - translation).
py::tuple frame_of(const Transformation& t) {
  return py::make_tuple(vector(t.rotation, {3, 3}), vector(t.translation, {3}));
}

void bind_material(py::module_& module) {
  py::class_<MaterialOf>(module, "Material", "What volumes are filled with.")
      .def_property_readonly(
          "number", [](const MaterialOf& m) { return m.number; }, "Among detector.materials.")
      .def_property_readonly(
          "name", [](const MaterialOf& m) { return text(m->name); }, "As in the file.")
      .def_property_readonly(
          "density", [](const MaterialOf& m) { return m->density; },
          "g/cm3; 0 where the file gives none.")
      .def_property_readonly(
          "state", [](const MaterialOf& m) { return state_name(m->state); },
          "'solid', 'liquid', 'gas' or 'undefined', as the file has it.")
      .def_property_readonly(
          "temperature", [](const MaterialOf& m) { return m->temperature; }, "K.")
      .def_property_readonly(
          "pressure", [](const MaterialOf& m) { return m->pressure; }, "Pa.")
      .def_property_readonly(
          "radiation_length", [](const MaterialOf& m) { return m->radiation_length; },
          "mm; 0 where density or composition are not known.")
      .def_property_readonly(
          "elements",
          [](const MaterialOf& m) {
            py::list all;
            for (const ElementShare& share : m->elements) {
              all.append(
                  py::make_tuple(text(m.detector.element(share.element).name), share.fraction));
            }
            return all;
          },
          "Pairs of an element's name and its fraction of the mass.")
      .def("__eq__", &same<MaterialOf>, py::is_operator())
      .def("__hash__", &hash_of<MaterialOf>)
      .def("__repr__", [](const MaterialOf& m) {
        return "<navjit.Material " + py::repr(text(m->name)).cast<std::string>() + ">";
      });
}

void bind_placement(py::module_& module) {
  py::class_<PlacementOf>(module, "Placement", "A daughter in its mother.")
      .def_property_readonly(
          "name", [](const PlacementOf& p) { return text(p->name); },
          "As in the file, or made of the volume's.")
      .def_property_readonly(
          "volume",
          [](const PlacementOf& p) {
            return VolumeOf{p.detector, p->volume};
          },
          "The logical volume that is placed.")
      .def_property_readonly(
          "mother",
          [](const PlacementOf& p) {
            return VolumeOf{p.detector, p.mother};
          },
          "The logical volume that it is placed in.")
      .def_property_readonly(
          "copy_number", [](const PlacementOf& p) { return p->copy_number; }, "As in the file.")
      .def_property_readonly(
          "translation",
          [](const PlacementOf& p) { return vector(p->transformation.translation, {3}); },
          "The daughter's origin in the mother's frame, mm; shape (3,).")
      .def_property_readonly(
          "rotation",
          [](const PlacementOf& p) {
            return vector(p->transformation.rotation, {3, 3});
          },
          "From the mother's frame into the daughter's: local = rotation @ (point - translation); "
          "shape (3, 3).")
      .def("__repr__", [](const PlacementOf& p) {
        return "<navjit.Placement " + py::repr(text(p->name)).cast<std::string>() + " in " +
               py::repr(text(p.detector.volume(p.mother).name)).cast<std::string>() + ">";
      });
}

void bind_volume(py::module_& module) {
  py::class_<VolumeOf>(module, "Volume", "A logical volume: a solid of a material, with daughters.")
      .def_property_readonly(
          "number", [](const VolumeOf& v) { return v.number; },
          "Among detector.volumes; what states have as volume.")
      .def_property_readonly(
          "name", [](const VolumeOf& v) { return text(v->name); }, "As in the file.")
      .def_property_readonly(
          "material",
          [](const VolumeOf& v) {
            return MaterialOf{v.detector, v->material};
          },
          "Of the volume outside its daughters.")
      .def_property_readonly(
          "solid", [](const VolumeOf& v) { return text(v->solid.name); }, "The solid's name.")
      .def_property_readonly(
          "solid_kind", [](const VolumeOf& v) { return kind_name(v->solid.kind); },
          "'box', 'tube', 'subtraction', ...")
      .def_property_readonly(
          "extent",
          [](const VolumeOf& v) {
            const Extent& e = v->solid.extent;
            const double both[6] = {e.min.x, e.min.y, e.min.z, e.max.x, e.max.y, e.max.z};
            return vector(both, {2, 3});
          },
          "Lower and upper corner of a box about the solid, mm; shape (2, 3).")
      .def_property_readonly(
          "capacity", [](const VolumeOf& v) { return capacity(v->solid); },
          "The solid's volume, mm3; nan where a boolean is involved.")
      .def_property_readonly(
          "touchables", [](const VolumeOf& v) { return v->touchables; },
          "Touchables in the tree below and including one placement of it.")
      .def_property_readonly(
          "daughters",
          [](const VolumeOf& v) {
            std::vector<PlacementOf> all;
            for (std::size_t i = 0; i < v->daughters.size(); ++i) {
              all.push_back({v.detector, v.number, i});
            }
            return all;
          },
          "Placements in it, in file order.")
      .def_property_readonly(
          "auxiliaries",
          [](const VolumeOf& v) {
            py::list all;
            if (v->auxiliaries) {
              for (const Auxiliary& a : *v->auxiliaries) {
                all.append(py::make_tuple(text(a.type), text(a.value)));
              }
            }
            return all;
          },
          "Tags of the file: pairs of type and value.")
      .def("__eq__", &same<VolumeOf>, py::is_operator())
      .def("__hash__", &hash_of<VolumeOf>)
      .def("__repr__", [](const VolumeOf& v) {
        return "<navjit.Volume " + py::repr(text(v->name)).cast<std::string>() + ">";
      });
}

std::vector<VolumeOf> volumes_of(const PythonDetector& d) {
  std::vector<VolumeOf> all;
  for (std::size_t i = 0; i < d.detector.volumes(); ++i) {
    all.push_back({d.detector, static_cast<VolumeId>(i)});
  }
  return all;
}

/// Paths of an array of states; empty outside the world. Most are few that come again and again.
py::list paths_of(const PythonDetector& d, const py::object& given) {
  const States at = states(given);
  py::dict known;
  py::list all(at.count);
  for (std::size_t i = 0; i < at.count; ++i) {
    const State& state = at.data[i];
    const py::int_ key(state.touchable());
    if (!known.contains(key)) {
      known[key] = state.inside() ? text(d.detector.path_of(state)) : py::str("");
    }
    all[i] = known[key];
  }
  return all;
}

State state_at(const PythonDetector& d, const std::vector<std::uint32_t>& daughters) {
  return d.detector.state_at(std::span<const std::uint32_t>(daughters));
}

State state_at_names(const PythonDetector& d,
                     const std::vector<std::pair<std::string, int>>& names) {
  std::vector<NamedPlacement> path;
  for (const auto& [name, copy_number] : names) path.push_back({name, copy_number});
  return d.detector.state_at(std::span<const NamedPlacement>(path));
}

/// Other threads of Python may go on meanwhile.
template <class Read>
PythonDetector read_unlocked(Read&& read) {
  const py::gil_scoped_release unlocked;
  GdmlReport report;
  Detector detector = read(&report);
  return PythonDetector{std::move(detector), std::move(report)};
}

}  // namespace

py::object python_detector(const Detector& detector) { return py::cast(PythonDetector{detector}); }

const Detector& detector_of(const py::object& given) {
  if (!py::isinstance<PythonDetector>(given)) {
    throw py::type_error("a navjit.Detector is needed, as read_gdml() gives it");
  }
  return given.cast<const PythonDetector&>().detector;
}

void bind_detector(py::module_& module) {
  bind_material(module);
  bind_placement(module);
  bind_volume(module);
  using D = PythonDetector;
  py::class_<D>(module, "Detector", "An immutable detector; made by read_gdml().")
      .def_property_readonly("volumes", &volumes_of, "All logical volumes, by their numbers.")
      .def_property_readonly(
          "materials",
          [](const D& d) {
            std::vector<MaterialOf> all;
            for (std::uint32_t i = 0; i < d.detector.materials(); ++i) {
              all.push_back({d.detector, i});
            }
            return all;
          },
          "All materials, by their numbers.")
      .def_property_readonly(
          "world",
          [](const D& d) {
            return VolumeOf{d.detector, d.detector.world_volume()};
          },
          "The logical volume that holds all others.")
      .def(
          "volume",
          [](const D& d, const std::string& name) {
            const auto found = d.detector.find_volume(name);
            if (!found) throw UsageError("there is no volume '" + name + "'");
            return VolumeOf{d.detector, *found};
          },
          py::arg("name"),
          "The first volume of that name in file order. Raises UsageError if there is none.")
      .def(
          "material",
          [](const D& d, const std::string& name) {
            for (std::uint32_t i = 0; i < d.detector.materials(); ++i) {
              if (d.detector.material(i).name == name) return MaterialOf{d.detector, i};
            }
            throw UsageError("there is no material '" + name + "'");
          },
          py::arg("name"),
          "The first material of that name in file order. Raises UsageError if there is none.")
      .def_property_readonly(
          "touchables", [](const D& d) { return d.detector.touchables(); },
          "Placed volumes in the whole tree, the world's included.")
      .def_property_readonly(
          "levels", [](const D& d) { return d.detector.levels(); },
          "Of the tree: 1 for a lone world volume.")
      .def_property_readonly(
          "tolerance", [](const D& d) { return d.detector.tolerance(); },
          "Points nearer to a face than this count as on it, mm.")
      .def_property_readonly(
          "notes", [](const D& d) { return d.report.notes; },
          "What was odd in the file and was read nevertheless: a line each, with file and line.")
      .def_property_readonly(
          "skipped", [](const D& d) { return d.report.skipped; },
          "What of the file means nothing for a geometry: a line for each kind.")
      .def(
          "path",
          [](const D& d, const py::object& state) {
            return text(d.detector.path_of(state_of(state)));
          },
          py::arg("state"),
          "'world/mother/daughter': the world volume's name, then placement names.")
      .def("paths", &paths_of, py::arg("states"),
           "path() of each state of an array, a list; '' outside the world.")
      .def(
          "daughter_numbers",
          [](const D& d, const py::object& state) { return d.detector.path(state_of(state)); },
          py::arg("state"), "The numbers of the daughters from the world volume down.")
      .def("state_at", &state_at, py::arg("daughters"),
           "The state of the touchable that is reached by numbers of daughters, or by pairs of "
           "placement name and copy number, from the world volume down.")
      .def("state_at", &state_at_names, py::arg("daughters"))
      .def(
          "mother",
          [](const D& d, const py::object& state) { return d.detector.mother(state_of(state)); },
          py::arg("state"), "The state of the touchable above; outside for the world volume's.")
      .def(
          "depth",
          [](const D& d, const py::object& state) { return d.detector.depth(state_of(state)); },
          py::arg("state"), "0 in the world volume.")
      .def(
          "copy_number",
          [](const D& d, const py::object& state) {
            return d.detector.copy_number(state_of(state));
          },
          py::arg("state"), "Of the state's placement; 0 for the world volume.")
      .def(
          "frame",
          [](const D& d, const py::object& state) {
            return frame_of(d.detector.frame(state_of(state)));
          },
          py::arg("state"),
          "(rotation, translation) from the world into the touchable: local = rotation @ (point - "
          "translation); shapes (3, 3) and (3,), mm.")
      .def(
          "gdml", [](const D& d) { return text(gdml_text(d.detector)); },
          "The detector as the text of a GDML file of its own.")
      .def("__repr__", [](const D& d) {
        return "<navjit.Detector of " + std::to_string(d.detector.volumes()) + " volumes, " +
               std::to_string(d.detector.touchables()) + " touchables>";
      });
  module.def(
      "read_gdml",
      [](const std::filesystem::path& path, const std::string& setup) {
        return read_unlocked([&](GdmlReport* report) {
          return read_gdml(path, {.setup = setup, .limits = {}}, report);
        });
      },
      py::arg("path"), py::arg("setup") = "",
      "Reads a detector from a GDML file.\n\n"
      "setup: the name of the <setup> to read; '': the one named 'Default', or the file's first.\n"
      "Raises ParseError, which names file, line and element.");
  module.def(
      "read_root",
      [](const std::filesystem::path& path, const std::string& key) {
        return read_unlocked([&](GdmlReport* report) {
          return read_root(path, {.key = key, .limits = {}}, report);
        });
      },
      py::arg("path"), py::arg("key") = "",
      "Reads a detector from a ROOT file with a TGeoManager.\n\n"
      "key: the name of the TGeoManager to read; '': the first.\n"
      "Raises ParseError, which names file and object.");
}

}  // namespace navjit::python
