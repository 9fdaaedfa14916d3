// A detector of few scenes, as a file: its navigators compile quickly on any machine.
#pragma once

#include <string>

#include "tests/support/command.hpp"

namespace navjit::tests {

/// A box of 2 m with 20 plates of two kinds across z.
inline void write_plates(const std::string& path) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<gdml>\n<define/>\n<materials><material name=\"Lead\" Z=\"82\">"
      "<D value=\"11.35\"/><atom value=\"207.2\"/></material></materials>\n<solids>\n"
      "<box name=\"all\" x=\"2000\" y=\"2000\" z=\"2000\"/>\n"
      "<box name=\"thin\" x=\"1000\" y=\"1000\" z=\"10\"/>\n"
      "<box name=\"thick\" x=\"1000\" y=\"1000\" z=\"30\"/>\n</solids>\n<structure>\n";
  const auto volume = [&](const std::string& name, const std::string& daughters) {
    text += "<volume name=\"" + name + "_v\"><materialref ref=\"Lead\"/><solidref ref=\"" + name +
            "\"/>" + daughters + "</volume>\n";
  };
  volume("thin", "");
  volume("thick", "");
  std::string plates;
  for (int i = 0; i < 20; ++i) {
    plates += "\n<physvol><volumeref ref=\"" + std::string(i % 2 == 0 ? "thin" : "thick") +
              "_v\"/><position name=\"p" + std::to_string(i) + "\" z=\"" +
              std::to_string(-475 + 50 * i) + "\"/></physvol>";
  }
  volume("all", plates);
  write_file(path, text +
                       "</structure>\n<setup name=\"Default\" version=\"1.0\"><world "
                       "ref=\"all_v\"/></setup>\n</gdml>\n");
}

}  // namespace navjit::tests
