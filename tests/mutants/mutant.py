"""A mutant: one change of a source; and where in a text it can be made."""
# Why a generated mutant is made; a listed one says more.
GENERATED = ("comparison", "sign", "logic", "number", "condition", "statement", "early end")


def code_lines(text):
    """(offset, line) of lines of code, without what is to the right of //."""
    offset = 0
    for line in text.splitlines(keepends=True):
        code = line.split("//")[0]
        if code.strip() and not code.lstrip().startswith(("#", "template", "static_assert")):
            yield offset, code
        offset += len(line)


class Mutant:
    def __init__(self, file, position, old, new, why, text):
        self.file, self.position, self.old, self.new, self.why = file, position, old, new, why
        self.status, self.detail, self.tiers, self.target = "", "", "", "fma"
        self.listed = why not in GENERATED
        self.line = text.count("\n", 0, position) + 1 if position >= 0 else 0
        start = text.rfind("\n", 0, position) + 1
        self.source = text[start:text.find("\n", position)].strip() if position >= 0 else ""
        self.column, self.repeat = position - start, text.count(self.source, 0, max(start, 0))


def nth(text, part, occurrence):
    """Where that occurrence of a part begins, -1 if there is none."""
    position = -1
    for _ in range(occurrence + 1):
        position = text.find(part, position + 1)
        if position < 0:
            break
    return position


def spread(items):
    """The same items so ordered that however many are taken from the front, they lie about evenly."""
    turn = (5 ** 0.5 - 1) / 2
    return [items[i] for i in sorted(range(len(items)), key=lambda i: i * turn % 1)]
