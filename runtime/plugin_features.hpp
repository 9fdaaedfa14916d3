// Instruction sets that code in plugins may use, with all their names.
#pragma once

// X(LLVM's name, the macro that compilers define if it is enabled). The names are also those that
// GCC has for __builtin_cpu_supports. Features that are not listed are turned off when a plugin is
// compiled.
#define NAVJIT_PLUGIN_FEATURES(X)       \
  X("sse3", "__SSE3__")                 \
  X("ssse3", "__SSSE3__")               \
  X("sse4.1", "__SSE4_1__")             \
  X("sse4.2", "__SSE4_2__")             \
  X("sse4a", "__SSE4A__")               \
  X("popcnt", "__POPCNT__")             \
  X("lzcnt", "__LZCNT__")               \
  X("movbe", "__MOVBE__")               \
  X("adx", "__ADX__")                   \
  X("aes", "__AES__")                   \
  X("pclmul", "__PCLMUL__")             \
  X("f16c", "__F16C__")                 \
  X("avx", "__AVX__")                   \
  X("avx2", "__AVX2__")                 \
  X("fma", "__FMA__")                   \
  X("fma4", "__FMA4__")                 \
  X("xop", "__XOP__")                   \
  X("tbm", "__TBM__")                   \
  X("bmi", "__BMI__")                   \
  X("bmi2", "__BMI2__")                 \
  X("gfni", "__GFNI__")                 \
  X("vpclmulqdq", "__VPCLMULQDQ__")     \
  X("avxvnni", "__AVXVNNI__")           \
  X("avx512f", "__AVX512F__")           \
  X("avx512cd", "__AVX512CD__")         \
  X("avx512dq", "__AVX512DQ__")         \
  X("avx512bw", "__AVX512BW__")         \
  X("avx512vl", "__AVX512VL__")         \
  X("avx512ifma", "__AVX512IFMA__")     \
  X("avx512vbmi", "__AVX512VBMI__")     \
  X("avx512vbmi2", "__AVX512VBMI2__")   \
  X("avx512vnni", "__AVX512VNNI__")     \
  X("avx512bitalg", "__AVX512BITALG__") \
  X("avx512vpopcntdq", "__AVX512VPOPCNTDQ__")
