// Eight numbers at once, for kernels that ask many faces or boxes the same question. Vector
// extensions that GCC and Clang share; operations are those of each lane alone, so that bits are
// those of a loop.
namespace navjit::kernels {

/// A number for each of eight lanes.
template <class Number>
struct EightOf {
  Number a, b, c, d, e, f, g, h;
};

typedef double EightLanes __attribute__((vector_size(64)));
typedef long long EightMask __attribute__((vector_size(64)));

inline EightLanes eight_of(double x) { return EightLanes{x, x, x, x, x, x, x, x}; }
inline EightLanes lanes_from(const EightOf<double>& numbers) {
  EightLanes lanes;
  __builtin_memcpy(&lanes, &numbers, sizeof lanes);
  return lanes;
}

/// One bit for each lane that is all ones; the others are zero.
inline unsigned bits_of(EightMask set) {
#if defined(__clang__)
  typedef bool Bits __attribute__((ext_vector_type(8)));
  return __builtin_bit_cast(unsigned char, __builtin_convertvector(set, Bits));
#elif defined(__AVX__)
  typedef double Half __attribute__((vector_size(32)));
  Half halves[2];
  __builtin_memcpy(halves, &set, sizeof set);
  return static_cast<unsigned>(__builtin_ia32_movmskpd256(halves[0])) |
         static_cast<unsigned>(__builtin_ia32_movmskpd256(halves[1])) << 4;
#else
  unsigned bits = 0;
  for (int i = 0; i < 8; ++i) bits |= set[i] != 0 ? 1U << i : 0U;
  return bits;
#endif
}

/// The largest of all lanes, none of which is no number.
inline double largest_lane(const EightLanes& lanes) {
  typedef double Four __attribute__((vector_size(32)));
  typedef double Two __attribute__((vector_size(16)));
  const Four low = __builtin_shufflevector(lanes, lanes, 0, 1, 2, 3);
  const Four high = __builtin_shufflevector(lanes, lanes, 4, 5, 6, 7);
  const Four four = low > high ? low : high;
  const Two even = __builtin_shufflevector(four, four, 0, 1);
  const Two odd = __builtin_shufflevector(four, four, 2, 3);
  const Two two = even > odd ? even : odd;
  return larger(two[0], two[1]);
}

}  // namespace navjit::kernels
