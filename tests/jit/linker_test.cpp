#include "jit/linker.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>

#include "jit/compiler.hpp"

namespace navjit::jit {
namespace {

Object compiled(std::string_view source, const CompileOptions& options = {}) {
  auto object = compile(source, "unit.cpp", options);
  if (!object) {
    ADD_FAILURE() << object.failure().message;
    return {};
  }
  return *std::move(object);
}

Linker made_linker(const LinkerOptions& options = {}) {
  auto linker = Linker::create(options);
  if (!linker) throw std::runtime_error(linker.failure().message);
  return *std::move(linker);
}

std::size_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t total = 0;
  std::size_t resident = 0;
  statm >> total >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Sanitizers hold on to freed memory.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool freed_memory_is_returned = false;
#else
constexpr bool freed_memory_is_returned = true;
#endif

std::size_t mappings() {
  std::ifstream maps("/proc/self/maps");
  std::size_t lines = 0;
  for (std::string line; std::getline(maps, line);) ++lines;
  return lines;
}

/// The number of objects announced to the debugger in this process.
int announced_objects() {
  struct Entry {
    Entry* next;
  };
  struct Descriptor {
    std::uint32_t version, action;
    Entry* relevant;
    Entry* first;
  };
  const auto* descriptor =
      static_cast<const Descriptor*>(dlsym(RTLD_DEFAULT, "__jit_debug_descriptor"));
  if (descriptor == nullptr) return -1;
  int count = 0;
  for (const Entry* entry = descriptor->first; entry != nullptr; entry = entry->next) ++count;
  return count;
}

TEST(Linker, LinksAndCalls) {
  Linker linker = made_linker();
  const auto code = linker.link(
      compiled("static double table[] = {1, 2, 4};\n"
               "extern \"C\" { int calls = 7;\n"
               "double f(int i) { ++calls; return table[i] *= 2; }\n"
               "const char* name() { static const char* const names[] = {\"none\", \"one\"};\n"
               "  return names[calls > 7]; } }\n"));
  ASSERT_TRUE(code) << code.failure().message;
  auto* f = *code->function<double(int)>("f");
  EXPECT_EQ(std::string((*code->function<const char*()>("name"))()), "none");
  EXPECT_EQ(f(2), 8.0);
  EXPECT_EQ(f(2), 16.0);
  EXPECT_EQ(*static_cast<int*>(*code->symbol("calls")), 9);
  EXPECT_EQ(std::string((*code->function<const char*()>("name"))()), "one");
  EXPECT_EQ(code->symbol_names(), (std::vector<std::string>{"calls", "f", "name"}));
  EXPECT_GT(code->report().link_ms, 0.0);
  EXPECT_GT(code->report().mapped_bytes, 32u);
}

TEST(Linker, RunsGlobalsThatAreZero) {
  Linker linker = made_linker();
  const auto code =
      linker.link(compiled("static int zeros[1000]; extern \"C\" int next(int i) {\n"
                           "  return zeros[i]++; }\n"));
  ASSERT_TRUE(code) << code.failure().message;
  auto* next = *code->function<int(int)>("next");
  EXPECT_EQ(next(999), 0);
  EXPECT_EQ(next(999), 1);
  EXPECT_EQ(next(0), 0);
}

TEST(Linker, FailsToFindMissingSymbols) {
  Linker linker = made_linker();
  const auto code = linker.link(compiled("extern \"C\" int f() { return 1; }"));
  ASSERT_TRUE(code);
  for (const char* name : {"g", "", "F", "process"}) {
    const auto symbol = code->symbol(name);
    ASSERT_FALSE(symbol) << name;
    EXPECT_NE(symbol.failure().message.find("no symbol"), std::string::npos);
  }
}

TEST(Linker, ResolvesMemoryAndMathematicalFunctions) {
  Linker linker = made_linker();
  const auto code = linker.link(compiled(
      "extern \"C\" {\n"
      "void copy(char* to, const char* from, unsigned long n) { __builtin_memcpy(to, from, n); }\n"
      "double mod(double x, double y) { return __builtin_fmod(x, y); }\n"
      "float modf_(float x, float y) { return __builtin_fmodf(x, y); }\n"
      "void both(double x, double* r) { r[0] = __builtin_sin(x); r[1] = __builtin_cos(x); }\n"
      "double root(double x) { return __builtin_sqrt(x); } }\n"));
  ASSERT_TRUE(code) << code.failure().message;
  char to[6] = {};
  (*code->function<void(char*, const char*, unsigned long)>("copy"))(to, "hello", 5);
  EXPECT_EQ(std::string(to), "hello");
  EXPECT_EQ((*code->function<double(double, double)>("mod"))(7.5, 2.0), std::fmod(7.5, 2.0));
  EXPECT_EQ((*code->function<float(float, float)>("modf_"))(7.5f, 2.0f), 1.5f);
  double r[2];
  (*code->function<void(double, double*)>("both"))(0.5, r);
  EXPECT_EQ(r[0], std::sin(0.5));
  EXPECT_EQ(r[1], std::cos(0.5));
  EXPECT_EQ((*code->function<double(double)>("root"))(2.0), std::sqrt(2.0));
}

TEST(Linker, RefusesOtherExternalSymbols) {
  Linker linker = made_linker();
  const int announced = announced_objects();
  for (const char* name : {"system", "malloc", "no_such_function_anywhere"}) {
    const auto code =
        linker.link(compiled("extern \"C\" void* " + std::string(name) +
                             "(long);\nextern \"C\" void* f() { return " + name + "(1); }"));
    ASSERT_FALSE(code) << name;
    EXPECT_NE(code.failure().message.find(name), std::string::npos) << code.failure().message;
  }
  EXPECT_EQ(announced_objects(), announced);
  EXPECT_TRUE(linker.link(compiled("int f() { return 1; }")));
}

TEST(Linker, RefusesThreadLocalVariables) {
  Linker linker = made_linker();
  EXPECT_FALSE(linker.link(compiled("thread_local int x = 3; int f() { return ++x; }")));
}

TEST(Linker, RefusesWhatIsNoObject) {
  Linker linker = made_linker();
  const Object good = compiled("extern \"C\" double f(double x) { return x + 1.5; }");
  ASSERT_GT(good.bytes.size(), 64u);
  EXPECT_FALSE(linker.link(Object{}));
  Object text;
  text.bytes.assign(1000, 'x');
  EXPECT_FALSE(linker.link(text));
  Object other_machine = good;
  other_machine.bytes[18] = static_cast<char>(183);  // e_machine: AArch64
  const auto foreign = linker.link(other_machine);
  ASSERT_FALSE(foreign);
  EXPECT_NE(foreign.failure().message.find("aarch64"), std::string::npos)
      << foreign.failure().message;
  Object not_relocatable = good;
  not_relocatable.bytes[16] = 2;  // e_type: executable
  EXPECT_FALSE(linker.link(not_relocatable));
  for (std::size_t size = 1; size < good.bytes.size(); size += 7) {
    Object truncated = good;
    truncated.bytes.resize(size);
    EXPECT_FALSE(linker.link(truncated)) << size;
  }
  EXPECT_TRUE(linker.link(good));
}

TEST(Linker, KeepsObjectsApart) {
  Linker linker = made_linker();
  const Object object = compiled("extern \"C\" { int count = 0; int next() { return ++count; } }");
  auto first = linker.link(object);
  auto second = linker.link(object);
  ASSERT_TRUE(first && second);
  auto* next_of_first = *first->function<int()>("next");
  auto* next_of_second = *second->function<int()>("next");
  EXPECT_NE(next_of_first, next_of_second);
  EXPECT_EQ(next_of_first(), 1);
  EXPECT_EQ(next_of_first(), 2);
  EXPECT_EQ(next_of_second(), 1);
  { const Code gone = *std::move(first); }
  EXPECT_EQ(next_of_second(), 2);
}

TEST(Linker, CodeMovesAndOutlivesItsLinker) {
  std::optional<Code> code;
  {
    Linker linker = made_linker();
    auto linked = linker.link(compiled("extern \"C\" int f() { return 5; }"));
    ASSERT_TRUE(linked);
    code.emplace(*std::move(linked));
  }
  EXPECT_EQ((*code->function<int()>("f"))(), 5);
  Code moved = *std::move(code);
  code = std::nullopt;
  EXPECT_EQ((*moved.function<int()>("f"))(), 5);
}

TEST(Linker, LinksInAnotherProcess) {
  const Object object = compiled(
      "static const double table[] = {1.5, 2.5};\n"
      "extern \"C\" const double* const rows[] = {table, table + 1};\n"
      "extern \"C\" double f(int i) { return rows[i][0] + __builtin_fmod(5.5, (double)i + 1); }");
  const std::string path = testing::TempDir() + "navjit_object_" + std::to_string(getpid()) + ".o";
  std::ofstream(path, std::ios::binary)
      .write(object.bytes.data(), static_cast<std::streamsize>(object.bytes.size()));
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    // Shifts where memory is mapped.
    [[maybe_unused]] static char* volatile shift = new char[50 << 20];
    std::ifstream file(path, std::ios::binary);
    Object read;
    read.bytes.assign(std::istreambuf_iterator<char>(file), {});
    auto linker = Linker::create();
    if (!linker) _exit(2);
    auto code = linker->link(read);
    if (!code) _exit(3);
    _exit((*code->function<double(int)>("f"))(1) == 4.0 ? 0 : 4);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  std::remove(path.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(Linker, ReturnsMemory) {
  if (!freed_memory_is_returned) GTEST_SKIP() << "a sanitizer keeps freed memory";
  Linker linker = made_linker();
  const Object object = compiled(
      "static double table[2000] = {1};\n"
      "extern \"C\" double some_function_with_a_long_name(int i) { return table[i] += 1; }");
  const auto link_and_drop = [&](int times) {
    for (int i = 0; i < times; ++i) {
      const auto code = linker.link(object);
      ASSERT_TRUE(code) << code.failure().message;
      ASSERT_EQ((*code->function<double(int)>("some_function_with_a_long_name"))(0), 2.0);
    }
  };
  link_and_drop(200);  // pools and arenas reach their size
  const std::size_t resident = resident_bytes();
  const std::size_t mapped = mappings();
  const int announced = announced_objects();
  link_and_drop(2000);
  EXPECT_LT(resident_bytes(), resident + (std::size_t{2} << 20));
  EXPECT_LE(mappings(), mapped + 4);
  EXPECT_EQ(announced_objects(), announced);
}

TEST(Linker, FailuresReturnMemory) {
  if (!freed_memory_is_returned) GTEST_SKIP() << "a sanitizer keeps freed memory";
  Linker linker = made_linker();
  const Object object = compiled("int g(); int table[5000] = {1}; int f() { return g(); }");
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(linker.link(object));
  const std::size_t resident = resident_bytes();
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(linker.link(object));
  EXPECT_LT(resident_bytes(), resident + (std::size_t{2} << 20));
}

TEST(Compiler, ReturnsMemory) {
  if (!freed_memory_is_returned) GTEST_SKIP() << "a sanitizer keeps freed memory";
  auto compiler = Compiler::create(CompileOptions{});
  ASSERT_TRUE(compiler);
  const char* source = "extern \"C\" double f(double x) { return x * x; }";
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(compiler->compile(source, "unit.cpp"));
  const std::size_t resident = resident_bytes();
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(compiler->compile(source, "unit.cpp"));
  EXPECT_LT(resident_bytes(), resident + (std::size_t{4} << 20));
}

TEST(Linker, AnnouncesCodeToTheDebuggerWhileItLives) {
  const Object object = compiled("extern \"C\" int f() { return 1; }");
  const int before = announced_objects();
  ASSERT_GE(before, 0);
  Linker linker = made_linker();
  {
    auto first = linker.link(object);
    std::optional<Code> second(*linker.link(object));
    const auto third = linker.link(object);
    ASSERT_TRUE(first && third);
    EXPECT_EQ(announced_objects(), before + 3);
    second.reset();
    EXPECT_EQ(announced_objects(), before + 2);
  }
  EXPECT_EQ(announced_objects(), before);

  Linker silent = made_linker({.debugger = false});
  const auto code = silent.link(object);
  EXPECT_EQ(announced_objects(), before);
}

TEST(Linker, WritesThePerfMap) {
  const std::string path = "/tmp/perf-" + std::to_string(getpid()) + ".map";
  std::remove(path.c_str());
  const Object object = compiled("extern \"C\" int function_for_perf(int i) { return i * 3; }");
  Linker silent = made_linker();
  const auto unlisted = silent.link(object);
  EXPECT_FALSE(std::ifstream(path).good());

  Linker linker = made_linker({.perf_map = true});
  const auto code = linker.link(object);
  ASSERT_TRUE(code);
  std::ifstream map(path);
  std::uintptr_t address = 0;
  std::size_t size = 0;
  std::string name;
  map >> std::hex >> address >> size >> name;
  EXPECT_EQ(address, reinterpret_cast<std::uintptr_t>(*code->symbol("function_for_perf")));
  EXPECT_EQ(name, "function_for_perf");
  EXPECT_GT(size, 0u);
  EXPECT_LE(size, object.report.code_bytes);
  std::remove(path.c_str());
}

}  // namespace
}  // namespace navjit::jit
