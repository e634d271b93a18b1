#pragma once

/// SCREE_MULTIVERSION before a function makes the compiler build it for AVX2 and AVX-512 machines
/// too; the loader picks. Contraction is off and sums are written in a fixed order, so every
/// version gives the same bits. Sanitizers and clang get the plain function.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(SCREE_SANITIZED)
#define SCREE_MULTIVERSION \
    __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SCREE_MULTIVERSION
#endif
