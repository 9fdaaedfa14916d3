// <define>: named numbers, vectors and tables.
#include <algorithm>
#include <array>

#include "geometry/gdml/context.hpp"

namespace navjit::gdml {
namespace {

void define_constant(FileContext& file, const XmlElement& element, std::string_view name,
                     double value) {
  if (file.evaluator.defined(name) == value) {
    return file.note(element, "its name is already defined, with the same value");
  }
  at_element(element, [&] { file.evaluator.define_constant(name, value); });
}

void read_constant(FileContext& file, const XmlElement& element) {
  define_constant(file, element, file.name(element), file.number(element, "value"));
}

void read_variable(FileContext& file, const XmlElement& element) {
  const double value = file.number(element, "value");
  at_element(element, [&] { file.evaluator.define_variable(file.name(element), value); });
}

void read_expression(FileContext& file, const XmlElement& element) {
  define_constant(file, element, file.name(element),
                  file.evaluate(element, element.text, "its text"));
}

void read_quantity(FileContext& file, const XmlElement& element) {
  const std::string name = file.name(element);
  const double value = file.number(element, "value");
  double product = value;
  if (element.find("unit") == "") {
    file.note(element, "took an empty unit for 1");
  } else {
    product *= file.unit(element, "unit", Dimension::other);
  }
  file.quantities.insert_or_assign(name, product);
  define_constant(file, element, name, product);
}

void read_position(FileContext& file, const XmlElement& element) {
  file.positions.insert_or_assign(file.name(element), file.vector(element, Dimension::length));
}

void read_rotation(FileContext& file, const XmlElement& element) {
  file.rotations.insert_or_assign(file.name(element), file.vector(element, Dimension::angle));
}

void read_scale(FileContext& file, const XmlElement& element) {
  file.scales.insert_or_assign(file.name(element), file.vector(element, Dimension::other, 1));
}

/// The elements of a matrix become constants name_i or name_i_j, counted from 0; expressions write
/// them as name[i] or name[i,j], counted from 1.
void read_matrix(FileContext& file, const XmlElement& element) {
  const std::string name = file.name(element);
  const int columns = file.integer(element, "coldim");
  std::string_view text = element.find("values").value_or("");
  // An element that cannot be read matters only to what uses it.
  std::vector<std::optional<double>> values;
  std::string problem;
  std::size_t problems = 0;
  for (;;) {
    const auto begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) break;
    const auto end = std::min(text.find_first_of(" \t\r\n", begin), text.size());
    if (file.session.xml.elements == 0) {
      refuse(element,
             "too many values in the file's matrices; raise GdmlLimits::max_elements if this is "
             "meant");
    }
    --file.session.xml.elements;
    values.emplace_back();
    try {
      values.back() = file.evaluate(element, text.substr(begin, end - begin), "values");
    } catch (const GdmlError& e) {
      if (++problems > 100) throw;
      if (problem.empty()) problem = e.what();
    }
    text.remove_prefix(end);
  }
  const auto size = static_cast<int>(values.size());
  if (columns < 1 || size == 0 || size % columns != 0) {
    fail(element, "it has " + std::to_string(size) +
                      " values in rows of coldim=" + std::to_string(columns) + "; fill every row");
  }
  const bool one_index = columns == 1 || columns == size;
  for (int i = 0; i < size; ++i) {
    std::string constant = name + "_" + std::to_string(one_index ? i : i / columns);
    if (!one_index) constant += "_" + std::to_string(i % columns);
    const std::optional<double> value = values[static_cast<std::size_t>(i)];
    if (value) {
      define_constant(file, element, constant, *value);
    } else {
      file.evaluator.define_broken(constant, problem);
    }
  }
  if (!problem.empty()) file.leave_out(element, problem);
}

constexpr struct {
  std::string_view tag;
  ElementReader read;
} readers[] = {
    {"position", read_position}, {"rotation", read_rotation}, {"constant", read_constant},
    {"variable", read_variable}, {"quantity", read_quantity}, {"expression", read_expression},
    {"scale", read_scale},       {"matrix", read_matrix},
};

}  // namespace

void read_define(FileContext& file, const XmlElement& section) {
  for (const XmlElement& element : section.children()) {
    file.charge(element);
    if (element.tag == "loop") {
      file.define_if_readable(element, "loop",
                              [&] { file.loop(element, [&] { read_define(file, element); }); });
      continue;
    }
    if (element.tag == "auxiliary") {
      file.skip("skipped <auxiliary>");
      continue;
    }
    const auto* reader = std::find_if(std::begin(readers), std::end(readers),
                                      [&](const auto& r) { return r.tag == element.tag; });
    if (reader == std::end(readers)) {
      file.note(element, "left out a definition of an unknown kind");
      continue;
    }
    const bool frame =
        reader->tag == "position" || reader->tag == "rotation" || reader->tag == "scale";
    file.define_if_readable(element, frame ? std::string(reader->tag) : "value",
                            [&] { reader->read(file, element); });
  }
}

}  // namespace navjit::gdml
