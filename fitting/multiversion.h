#pragma once

// Elementwise loops are compiled for several instruction sets, one of which is
// picked at run time. Without contraction, and with sums in a fixed number of
// lanes, all give the same bits. Not under ThreadSanitizer: the loader picks
// before the sanitizer is ready, and the code that picks is instrumented, too.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && \
    !defined(__SANITIZE_THREAD__)
#define ERRMAP_MULTIVERSION \
  __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ERRMAP_MULTIVERSION
#endif
