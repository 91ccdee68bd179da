/* Loaded before a program (LD_PRELOAD): gives its process another floating-point environment before main, as a library
   linked with -ffast-math does. OTHER_ENVIRONMENT holds the rounding (n, u, d or z) and the bits of MXCSR to set, in
   hexadecimal. */
#include <fenv.h>
#include <stdlib.h>
#include <xmmintrin.h>

__attribute__((constructor)) static void set_environment(void) {
    const char* const text = getenv("OTHER_ENVIRONMENT");
    if (text == NULL || text[0] == '\0') return;
    fesetround(text[0] == 'u'   ? FE_UPWARD
               : text[0] == 'd' ? FE_DOWNWARD
               : text[0] == 'z' ? FE_TOWARDZERO
                                : FE_TONEAREST);
    _mm_setcsr(_mm_getcsr() | (unsigned)strtoul(text + 1, NULL, 16));
}
