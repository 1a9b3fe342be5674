// The instruction sets for which batch kernels are compiled; include before hwy/foreach_target.h.
#pragma once

// SSE2, AVX2 and AVX-512 are enough: others between them have no wider doubles.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
