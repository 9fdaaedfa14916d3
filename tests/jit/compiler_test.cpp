#include "jit/compiler.hpp"

#include <gtest/gtest.h>

#include <string>

namespace navjit::jit {
namespace {

Expected<Object> compile_text(std::string_view source) {
  return compile(source, "unit.cpp", CompileOptions{});
}

std::string failure_of(std::string_view source) {
  const Expected<Object> object = compile_text(source);
  return object ? "compiled" : object.failure().message;
}

TEST(Compiler, ProducesAnElfObjectAndAReport) {
  const auto object = compile_text("extern \"C\" int answer() { return 42; }");
  ASSERT_TRUE(object) << object.failure().message;
  EXPECT_EQ(std::string(object->bytes.data(), 4),
            "\x7f"
            "ELF");
  EXPECT_GT(object->report.code_bytes, 0u);
  EXPECT_LT(object->report.code_bytes, 64u);
  EXPECT_GT(object->report.frontend_ms, 0.0);
  EXPECT_GT(object->report.optimise_ms, 0.0);
  EXPECT_GT(object->report.codegen_ms, 0.0);
  EXPECT_EQ(object->warnings, "");
}

TEST(Compiler, IsDeterministic) {
  const char* source = "extern \"C\" double f(double x) { return x * 3.0 + 1.0; }";
  auto compiler = Compiler::create(CompileOptions{});
  ASSERT_TRUE(compiler) << compiler.failure().message;
  const auto first = compiler->compile(source, "unit.cpp");
  const auto other = compiler->compile("extern \"C\" int g() { return 1; }", "unit.cpp");
  const auto again = compiler->compile(source, "unit.cpp");
  ASSERT_TRUE(first && other && again);
  EXPECT_EQ(first->bytes, again->bytes);
  EXPECT_NE(first->bytes, other->bytes);
}

TEST(Compiler, ReportsErrorsWithLineNumbers) {
  const std::string message =
      failure_of("int a() { return 0; }\nint b() {\n  return missing;\n}\n");
  EXPECT_NE(message.find("unit.cpp:3:10: error:"), std::string::npos) << message;
  EXPECT_NE(message.find("missing"), std::string::npos) << message;
}

TEST(Compiler, ReportsAllErrors) {
  const std::string message = failure_of("int a() { return x; }\nint b() { return y; }\n");
  EXPECT_NE(message.find("unit.cpp:1:"), std::string::npos) << message;
  EXPECT_NE(message.find("unit.cpp:2:"), std::string::npos) << message;
}

TEST(Compiler, ReportsErrorsBeforeWarnings) {
  const std::string message = failure_of(
      "void f(int x) {\n  x == 1;\n  x == 2;\n}\nint g();\n"
      "int b() { return g(1); }\nvoid h(int x) { x == 3; }\n");
  EXPECT_EQ(message.find("unit.cpp:6:18: error:"), 0U) << message;
  const std::size_t note = message.find("unit.cpp:5:5: note:"), warning = message.find("warning:");
  ASSERT_NE(warning, std::string::npos) << message;
  EXPECT_LT(note, warning) << message;
}

TEST(Compiler, IsUsableAfterAFailure) {
  auto compiler = Compiler::create(CompileOptions{});
  ASSERT_TRUE(compiler);
  EXPECT_FALSE(compiler->compile("int f( {", "bad.cpp"));
  EXPECT_TRUE(compiler->compile("int f() { return 1; }", "good.cpp"));
}

TEST(Compiler, KeepsWarnings) {
  const auto object = compile_text("extern \"C\" int f(int x) { x == 1; return 2; }");
  ASSERT_TRUE(object) << object.failure().message;
  EXPECT_NE(object->warnings.find("unused"), std::string::npos) << object->warnings;
}

TEST(Compiler, RefusesSourceWithoutFunctions) {
  for (const char* source : {"", " \n\n", "// nothing\n", "static int f() { return 1; }"}) {
    EXPECT_NE(failure_of(source).find("no function visible"), std::string::npos) << source;
  }
}

TEST(Compiler, RefusesGarbage) {
  EXPECT_NE(failure_of(std::string("\0\x01\xff\xfe{{{\"", 8)), "compiled");
  EXPECT_NE(failure_of("\xef\xbb\xbf\xff\xff"), "compiled");
  EXPECT_NE(failure_of("\xff\xfe\x20\x00"), "compiled");
  std::string noise;
  unsigned state = 1;
  for (int i = 0; i < 100000; ++i) {
    state = state * 1664525u + 1013904223u;
    noise += static_cast<char>(state >> 24);
  }
  EXPECT_NE(failure_of(noise), "compiled");
}

TEST(Compiler, RefusesIncludes) {
  EXPECT_NE(failure_of("#include <cmath>\nint f() { return 1; }").find("file not found"),
            std::string::npos);
  EXPECT_NE(failure_of("#include \"/etc/passwd\"\nint f() { return 1; }").find("file not found"),
            std::string::npos);
  EXPECT_NE(failure_of("#embed \"/etc/passwd\"\nint f() { return 1; }").find("file not found"),
            std::string::npos);
  EXPECT_NE(failure_of("#include \"unit.cpp\"\nint f() { return 1; }").find("too deeply"),
            std::string::npos);
  EXPECT_NE(failure_of("#include <stddef.h>\nint f() { return 1; }").find("file not found"),
            std::string::npos);
}

TEST(Compiler, RefusesInitialisationAtLoadTime) {
  EXPECT_NE(failure_of("int g();\nint x = g();\nextern \"C\" int f() { return x; }")
                .find("not initialised by a constant"),
            std::string::npos);
}

TEST(Compiler, RefusesErrorsOfTheAssembler) {
  const std::string message = failure_of("extern \"C\" void f() { asm(\"no_such_op %rax\"); }");
  EXPECT_NE(message.find("no_such_op"), std::string::npos) << message;
  EXPECT_NE(message.find("invalid instruction"), std::string::npos) << message;
}

TEST(Compiler, RefusesExceptionsAndRtti) {
  EXPECT_NE(failure_of("int f() { throw 1; }").find("exceptions disabled"), std::string::npos);
  EXPECT_NE(failure_of("struct A { virtual void g(); }; struct B : A {};\n"
                       "bool f(A* a) { return dynamic_cast<B*>(a) != nullptr; }"),
            "compiled");
}

TEST(Compiler, RefusesLongSource) {
  CompileOptions options;
  options.max_source_bytes = 100;
  auto compiler = Compiler::create(options);
  ASSERT_TRUE(compiler);
  std::string source = "int f() { return 1; }";
  EXPECT_TRUE(compiler->compile(source, "unit.cpp"));
  source.append(100, ' ');
  const auto object = compiler->compile(source, "unit.cpp");
  ASSERT_FALSE(object);
  EXPECT_NE(object.failure().message.find("limit of 100"), std::string::npos);
}

TEST(Compiler, SurvivesDeepNesting) {
  std::string sum = "extern \"C\" double f(double x) { return x";
  for (int i = 0; i < 15000; ++i) sum += "+x";
  sum += "; }";
  EXPECT_EQ(failure_of(sum), "compiled");

  const std::string open(1000, '(');
  EXPECT_NE(failure_of("int f() { return " + open + "1" + std::string(1000, ')') + "; }")
                .find("bracket nesting level exceeded"),
            std::string::npos);

  EXPECT_NE(failure_of("template <int N> struct T { static constexpr int v = T<N - 1>::v; };\n"
                       "int f() { return T<100>::v; }")
                .find("template instantiation depth"),
            std::string::npos);
}

TEST(Compiler, RefusesExpressionsTooLongForItsStack) {
  const auto complements = [](std::size_t n) {
    return std::string("\n\nint f(int x) { return ").append(n, '~').append("x; }");
  };
  EXPECT_EQ(failure_of(complements(32000)), "compiled");
  const std::string message = failure_of(complements(1000000));
  EXPECT_EQ(message, "unit.cpp:3: error: expression of more than 32768 tokens");

  // The same number of tokens in a table is no problem.
  std::string table = "extern \"C\" { extern const int table[] = {0";
  for (int i = 1; i < 40000; ++i) table += ",1";
  table += "}; int f(int i) { return table[i]; } }";
  EXPECT_EQ(failure_of(table), "compiled");
}

TEST(Compiler, RefusesNamesThatAreNotPaths) {
  auto compiler = Compiler::create(CompileOptions{});
  ASSERT_TRUE(compiler);
  const char* source = "int f() { return 1; }";
  for (const char* name : {"-", "-o", "a\nb", "."}) {
    EXPECT_FALSE(compiler->compile(source, name)) << name;
  }
  for (const char* name : {"", "a", "/a/b.cpp", "a/../b", "a \"b\".cpp", "\xc3\xa4.cpp"}) {
    const auto object = compiler->compile(source, name);
    EXPECT_TRUE(object) << object.failure().message;
  }
}

TEST(Compiler, RefusesUnknownTargetsAndLevels) {
  CompileOptions options;
  options.cpu = "pentium-nonesuch";
  EXPECT_NE(compile("int f();", "u", options).failure().message.find("unknown processor 'pentium"),
            std::string::npos);
  options.cpu = "";
  for (const char* feature : {"+nonesuch", "avx2", "", "+"}) {
    options.features = {feature};
    EXPECT_NE(compile("int f();", "u", options).failure().message.find("unknown processor feature"),
              std::string::npos)
        << feature;
  }
  options.features = {"-sse2"};
  EXPECT_NE(compile("double f(double x) { return x * x; }", "u", options)
                .failure()
                .message.find("lacks the processor feature 'sse2'"),
            std::string::npos);
  options.features.clear();
  for (const char* cpu : {"i386", "pentium3", "help"}) {
    options.cpu = cpu;
    EXPECT_FALSE(Compiler::create(options)) << cpu;
  }
  options.cpu = "";
  options.optimisation = 4;
  EXPECT_FALSE(Compiler::create(options));
  options.optimisation = -1;
  EXPECT_FALSE(Compiler::create(options));
}

TEST(Compiler, AcceptsAllLevelsAndDebugInformation) {
  const char* source = "extern \"C\" double f(double x) { double y = x * x; return y + 1; }";
  for (int level = 0; level <= 3; ++level) {
    CompileOptions options;
    options.optimisation = level;
    const auto plain = compile(source, "unit.cpp", options);
    ASSERT_TRUE(plain) << plain.failure().message;
    options.debug_info = true;
    const auto debug = compile(source, "unit.cpp", options);
    ASSERT_TRUE(debug) << debug.failure().message;
    const std::string bytes(debug->bytes.begin(), debug->bytes.end());
    EXPECT_NE(bytes.find(".debug_line"), std::string::npos);
    EXPECT_GT(debug->bytes.size(), plain->bytes.size());
  }
}

TEST(Compiler, VectorisesOnlyFromLevelTwo) {
  const char* source =
      "extern \"C\" void f(double* __restrict a, const double* b) {\n"
      "  for (int i = 0; i < 1024; ++i) a[i] = b[i] * 2.0;\n}\n";
  CompileOptions options;
  options.cpu = "x86-64-v3";
  options.optimisation = 1;
  const auto scalar = compile(source, "unit.cpp", options);
  options.optimisation = 2;
  const auto vector = compile(source, "unit.cpp", options);
  ASSERT_TRUE(scalar && vector);
  // Four unrolled vector operations, where the scalar loop has one.
  EXPECT_GT(vector->report.code_bytes, scalar->report.code_bytes + 32);
}

TEST(TargetDescription, TellsApartWhatGivesDifferentCode) {
  CompileOptions options;
  const std::string host = target_description(options);
  EXPECT_EQ(host, target_description(options));
  EXPECT_NE(host.find("19."), std::string::npos) << host;
  EXPECT_EQ(host.find('\n'), std::string::npos);
  auto compiler = Compiler::create(options);
  ASSERT_TRUE(compiler);
  EXPECT_EQ(compiler->target_description(), host);

  CompileOptions level = options;
  level.optimisation = 1;
  EXPECT_NE(target_description(level), host);
  CompileOptions features = options;
  features.features = {"-avx2"};
  EXPECT_NE(target_description(features), host);
  CompileOptions cpu = options;
  cpu.cpu = "x86-64-v2";
  EXPECT_NE(target_description(cpu), host);
  CompileOptions debug = options;
  debug.debug_info = true;
  EXPECT_NE(target_description(debug), host);
}

}  // namespace
}  // namespace navjit::jit
