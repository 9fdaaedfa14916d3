// Which values options accept, and what they say about those that they refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/support/command.hpp"
#include "tests/support/folder.hpp"

namespace navjit::tests {
namespace {

constexpr auto npos = std::string::npos;
const std::string detector = NAVJIT_DETECTORS_DIR "/absorber.gdml";

/// Expects wrong usage, reported in one line that has these words.
void refuses(const std::string& arguments, const std::string& words) {
  const Output output = run_navjit(arguments);
  EXPECT_EQ(output.status, 2) << arguments << ": " << output.text;
  EXPECT_NE(output.text.find(words), npos) << arguments << ": " << output.text;
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
}

TEST(Options, CountsAreWholeNumbers) {
  for (const std::string command : {"run ", "trace ", "accuracy "}) {
    const std::string rays = command + detector + " --rays=";
    refuses(rays + "0", "--rays: '0' is less than 1");
    refuses(rays + "-5", "'-5' is negative");
    refuses(rays + "1.5", "'1.5' is not a whole number");
    refuses(rays + "18446744073709551615", "is more than 1000000000000000");
    refuses(rays + "1e30", "is more than 1000000000000000");
  }
  refuses("run " + detector + " --rays 0x10", "is not a whole number");
  refuses("run " + detector + " --threads 0x2", "'0x2' is not a whole number");
  refuses("check " + detector + " --resolution 1.5", "is not a whole number");
  refuses("accuracy " + detector + " --repetitions 0", "'0' is less than 1");
  refuses("warmup " + detector + " --repetitions nan", "is not a whole number");
  refuses("run " + detector + " --seed 0x1", "is not a whole number");
  refuses("run " + detector + " --nice 20", "is more than 19");
  refuses("run " + detector + " --opt 4", "is more than 3");
}

TEST(Options, CountsMayHaveAnExponent) {
  const Output output = run_navjit("run " + detector + " --rays 1.5e2 --jit off");
  EXPECT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("\n150 rays, "), npos) << output.text;
  const Output trace = run_navjit("trace " + detector + " --rays 2e1 --jit off");
  EXPECT_EQ(trace.text.rfind("\n19,"), trace.text.rfind("\n19,0,")) << trace.text;
  EXPECT_NE(trace.text.find("\n19,0,"), npos) << trace.text;
}

TEST(Options, NumbersAreFiniteAndDecimal) {
  for (const std::string option :
       {"check DET --tolerance", "run DET --budget", "specialise DET --emit so -o x --least-share",
        "accuracy DET --vecgeom-seconds", "warmup DET --seconds", "warmup DET --prime",
        "warmup DET --interval"}) {
    std::string command = option;
    command.replace(command.find("DET"), 3, detector);
    const std::string name = command.substr(command.rfind(' ') + 1);
    for (const char* value : {"nan", "inf", "-inf", "0x1", "1e400", "1x"}) {
      refuses(command + "=" + value, name + ": '");
    }
    refuses(command + "=-1", name + ": '-1' is not ");
  }
  refuses("run " + detector + " --budget 0", "'0' is not above 0");
  for (const char* value : {"nan,0,0", "0,inf,0", "0x1,0,0", "0,0", "0,0,0,0", ",,"}) {
    refuses("run " + detector + " --origin=" + value, "--origin: ");
  }
}

TEST(Options, WordsAreListed) {
  refuses("run " + detector + " --jit maybe", "--jit: 'maybe' is not off, on, wait or shadow");
  refuses("run " + detector + " --jit 0", "'0' is not off, on, wait or shadow");
  refuses("trace " + detector + " --rays 1 --level fast",
          "--level: answers are always exact; what may be left out is --observe's to say");
  refuses("warmup " + detector + " --isa mmx", "'mmx' is not native, sse4.2, avx2 or avx512");
  refuses("warmup " + detector + " --modes cold,hot", "'hot' is not cold, cache or plugin");
  refuses("specialise " + detector + " --scene W --emit exe -o x", "'exe' is not so or cpp");
  refuses("accuracy " + detector + " --vecgeom-navigator best",
          "'best' is not simple, abbox, hybrid, bvh or automatic");
  for (const char* output : {"--jit maybe", "--isa mmx"}) {
    EXPECT_EQ(run_navjit("run " + detector + " " + output).text.find('{'), npos);
  }
}

TEST(Options, AnOriginOutsideTheWorldIsAnError) {
  for (const std::string command :
       {"run DET --rays 10", "accuracy DET --rays 10 --vecgeom off --boundaries 0 --repetitions 1",
        "warmup DET --seconds 0.1"}) {
    std::string line = command + " --origin 1e9,0,0";
    line.replace(line.find("DET"), 3, detector);
    const Output output = run_navjit(line);
    EXPECT_EQ(output.status, 1) << output.text;
    EXPECT_NE(output.text.find("the origin 1e+09,0,0 is outside the world"), npos) << output.text;
  }
}

TEST(Options, RaysThatStartOutsideAreTold) {
  const TemporaryFolder folder;
  write_file(folder.file("rays.csv"), "x,y,z,dx,dy,dz\n0,0,0,0,0,1\n1e9,0,0,1,0,0\n");
  const Output output =
      run_navjit("trace " + detector + " --jit off --rays " + folder.file("rays.csv"));
  EXPECT_EQ(output.status, 0);
  EXPECT_NE(output.text.find("navjit: 1 of 2 rays start outside the world"), npos) << output.text;
}

TEST(Options, VersionIsOneLine) {
  const Output output = run_navjit("--version");
  EXPECT_EQ(output.status, 0);
  EXPECT_EQ(output.text.find("navjit " NAVJIT_VERSION " ("), 0U) << output.text;
  EXPECT_NE(output.text.find(", LLVM 19."), npos) << output.text;
  EXPECT_NE(output.text.find(", kernels "), npos) << output.text;
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1);
  const Output production = run_command(NAVJIT_PRODUCTION, "--version");
  EXPECT_NE(production.text.find(", no LLVM, "), npos) << production.text;
}

TEST(Options, AFileWithoutANameIsNone) {
  for (const std::string option : {"--report", "--html", "--save-profile", "--aim", "--setup"}) {
    refuses("run " + detector + " --rays 1 " + option + " ''", option + ": the value is empty");
  }
  refuses("trace " + detector + " --rays 1 --out ''", "the value is empty");
  refuses("simplify " + detector + " -o ''", "the value is empty");
  refuses("scan " + detector + " --csv ''", "the value is empty");
  refuses("inspect " + detector + " --scene ''", "the value is empty");
  refuses("run " + detector + " --cache ''", "the value is empty");
}

TEST(Options, PicturesAreSvgOrPng) {
  for (const std::string command : {"scan ", "accuracy ", "warmup "}) {
    refuses(command + detector + " --picture p.jpg", "p.jpg: pictures are .svg or .png files");
  }
}

TEST(Options, RangesOfPseudorapidityAscend) {
  for (const std::string range : {"5,2", "800,900", "nan,1", "-16,0"}) {
    for (const std::string command : {"run ", "trace ", "scan "}) {
      refuses(command + detector + " --eta " + range, "--eta: ");
    }
  }
}

TEST(Options, OneFileIsNotTwo) {
  const TemporaryFolder folder;
  const std::string file = folder.path() + "/x", again = folder.path() + "/./x";
  refuses("run " + detector + " --rays 1 --report " + file + " --html " + again,
          "is the file of --html, too");
  const std::string own = folder.path() + "/own.gdml";
  std::filesystem::copy_file(detector, own);
  refuses("run " + own + " --rays 1 --report " + again + "/../own.gdml", "the detector, too");
  refuses("trace " + own + " --rays 1 --out " + own, "the detector, too");
  EXPECT_EQ(std::filesystem::file_size(own), std::filesystem::file_size(detector));
  refuses("simplify " + own + " --observe materials -o " + own, "the detector, too");
  refuses("import " + own + " -o " + own, "the file to import, too");
  refuses("report merge a.json " + file + " -o " + again, "a report to merge, too");
  refuses("profile merge " + file + " b -o " + again, "a profile to add, too");
  EXPECT_EQ(std::filesystem::file_size(own), std::filesystem::file_size(detector));
  // A number of rays is no file, whatever files are called.
  const Output ten = run_command("cd " + folder.path() + " && " NAVJIT_COMMAND,
                                 "trace own.gdml --rays 10 --out 10");
  EXPECT_EQ(ten.status, 0) << ten.text;
  const Output both =
      run_navjit("run " + detector + " --rays 1 --jit off --report /dev/null --html /dev/null");
  EXPECT_EQ(both.status, 0) << both.text;
}

TEST(Options, AWordThatIsNoSubcommandIsNamed) {
  refuses("specialize " + detector, "'specialize' is no subcommand");
  refuses("cache lst", "'lst' is no subcommand");
  refuses("", "A subcommand is required");
}

TEST(Options, AnOptionThatIsNoneIsNamed) {
  refuses("trace " + detector + " --ray 100",
          "'--ray' is no option of trace; see navjit trace --help");
  refuses("picture " + detector + " --out t.png", "'--out' is no option of picture");
  refuses("run --rayz 5 " + detector, "'--rayz' is no option of run");
  refuses("report merge a.json --output x.json", "'--output' is no option of report merge");
}

TEST(Options, HelpSaysWhatIsRequired) {
  const Output help = run_navjit("trace --help");
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.text.find("--rays"), npos);
  EXPECT_NE(help.text.find("REQUIRED"), npos) << help.text;
}

TEST(Options, EmptyNamesOfFilesAreWrongUsage) {
  for (const std::string& words :
       {"run " + detector + " --rays 1 --plugin \"\"", std::string("profile merge \"\" -o x"),
        std::string("plugin seal \"\""),
        "specialise " + detector + " --profile \"\" --emit so -o x.so"}) {
    refuses(words, "the value is empty");
  }
}

TEST(Options, ACacheThatIsOffIsToldSo) {
  const Output output = run_navjit("cache --cache off list");
  EXPECT_EQ(output.status, 1) << output.text;
  EXPECT_NE(output.text.find("it is off (by --cache or NAVJIT_CACHE)"), npos) << output.text;
}

}  // namespace
}  // namespace navjit::tests
