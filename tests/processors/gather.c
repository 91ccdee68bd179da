/* Does this processor, or what emulates it, gather rightly with ymm4 as the index register? qemu 7.2 takes the number 4
 * for "no index", as it is in addresses without vectors. Exit code 0: rightly, or there is no AVX2. */
#include <immintrin.h>

__attribute__((target("avx2"))) static int gathers(void) {
    long long numbers[4] = {10, 11, 12, 13}, offsets[4] = {0, 8, 16, 24}, got[4];
    __asm__ volatile(
        "vmovdqu %1, %%ymm4\n\tvpcmpeqd %%ymm7, %%ymm7, %%ymm7\n\tvpgatherqq %%ymm7, (%2,%%ymm4,1), %%ymm2\n\t"
        "vmovdqu %%ymm2, %0"
        : "=m"(got)
        : "m"(offsets), "r"(numbers), "m"(numbers)
        : "ymm2", "ymm4", "ymm7");
    return got[0] == 10 && got[1] == 11 && got[2] == 12 && got[3] == 13;
}

int main(void) {
    return !__builtin_cpu_supports("avx2") || gathers() ? 0 : 1;
}
