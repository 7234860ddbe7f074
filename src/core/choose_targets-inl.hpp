// What vector kernels are compiled for: AVX-512, AVX2, and plain C++ for anything older; the first two give the same
// bits.
#include <hwy/detect_targets.h>
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_AVX3_DL | HWY_SSE4 | HWY_SSSE3)
