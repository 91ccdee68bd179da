"""Why mutants of rooms survive: room, file, part of the line, replacement or "", explanation."""
ROOM_SURVIVORS = [
]
