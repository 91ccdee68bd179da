/// Files that are part of the library.
#pragma once

/// The bytes of the file from `name` to `name`_end, which is a zero. At file scope, once for each name.
#define BARYCERT_EMBED(name, path)                                                                                     \
    asm(".section .rodata\n.hidden " #name "\n.global " #name "\n.hidden " #name "_end\n.global " #name "_end\n" #name \
        ": .incbin \"" path "\"\n" #name "_end: .byte 0\n.previous\n");                                                \
    extern "C" const char name[], name##_end[]  // NOLINT(modernize-avoid-c-arrays,bugprone-macro-parentheses)
