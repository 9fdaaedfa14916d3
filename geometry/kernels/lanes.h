// Several numbers at once, for kernels that ask many faces or boxes the same question. This uses
// the vector extensions that GCC and Clang share. Each lane is computed on its own, so the bits are
// those of a loop over single numbers.
namespace navjit::kernels {

/// Whether a solid's kernels use vectors. Functions that serve all kinds of solids call such
/// kernels out of line, because the other kinds would pay for the vector registers.
template <class Shape>
inline constexpr bool uses_vectors = false;

typedef double Doubles __attribute__((vector_size(32)));
typedef unsigned long long Words __attribute__((vector_size(32)));
constexpr int lanes_of_four = 4;

inline Doubles four_of(double x) { return Doubles{x, x, x, x}; }

/// One bit for each lane, which is 1 if the lane is set. A set lane has all bits 1, any other lane
/// has all bits 0.
inline unsigned bits_of(Words set) {
#if defined(__clang__)
  typedef bool Bits __attribute__((ext_vector_type(4)));
  // The upper four of the eight bits belong to no lane.
  return __builtin_bit_cast(unsigned char, __builtin_convertvector(set, Bits)) & 15U;
#elif defined(__AVX__)
  return static_cast<unsigned>(__builtin_ia32_movmskpd256(__builtin_bit_cast(Doubles, set)));
#else
  unsigned bits = 0;
  for (int i = 0; i < lanes_of_four; ++i) bits |= set[i] != 0 ? 1U << i : 0U;
  return bits;
#endif
}

/// The largest of all lanes. Every lane must be a number (not NaN).
inline double largest_lane(Doubles lanes) {
  typedef double Two __attribute__((vector_size(16)));
  const Two even = __builtin_shufflevector(lanes, lanes, 0, 1);
  const Two odd = __builtin_shufflevector(lanes, lanes, 2, 3);
  const Two two = even > odd ? even : odd;
  // As vectors, because the comparison of two single numbers may become a branch.
  const Two other = __builtin_shufflevector(two, two, 1, 0);
  return (two > other ? two : other)[0];
}

/// A number for each of four lanes.
template <class Number>
struct FourOf {
  Number a, b, c, d;
};

inline Doubles lanes_from(const FourOf<double>& numbers) {
  Doubles lanes;
  __builtin_memcpy(&lanes, &numbers, sizeof lanes);
  return lanes;
}

/// A number for each of eight lanes.
template <class Number>
struct EightOf {
  Number a, b, c, d, e, f, g, h;
};

typedef double EightLanes __attribute__((vector_size(64)));
typedef unsigned long long EightWords __attribute__((vector_size(64)));

inline EightLanes eight_of(double x) { return EightLanes{x, x, x, x, x, x, x, x}; }
inline EightLanes lanes_from(const EightOf<double>& numbers) {
  EightLanes lanes;
  __builtin_memcpy(&lanes, &numbers, sizeof lanes);
  return lanes;
}

inline Doubles absolute(Doubles lanes) { return lanes < 0 ? -lanes : lanes; }
inline EightLanes absolute(EightLanes lanes) { return lanes < 0 ? -lanes : lanes; }

inline unsigned bits_of(EightWords set) {
#if defined(__clang__)
  typedef bool Bits __attribute__((ext_vector_type(8)));
  return __builtin_bit_cast(unsigned char, __builtin_convertvector(set, Bits));
#else
  Words halves[2];
  __builtin_memcpy(halves, &set, sizeof set);
  return bits_of(halves[0]) | bits_of(halves[1]) << lanes_of_four;
#endif
}
inline double largest_lane(EightLanes lanes) {
  const Doubles low = __builtin_shufflevector(lanes, lanes, 0, 1, 2, 3);
  const Doubles high = __builtin_shufflevector(lanes, lanes, 4, 5, 6, 7);
  return largest_lane(low > high ? low : high);
}

}  // namespace navjit::kernels
