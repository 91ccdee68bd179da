"""Why mutants survive: (file, part of the source line or of the changed text, replacement or "", explanation)."""
EXPLANATIONS = []
