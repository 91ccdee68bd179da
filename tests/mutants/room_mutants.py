"""What is changed in the other rooms: mutants that are listed there (room_lists.py), and those made of every line of code."""
import re
from itertools import zip_longest

from mutant import GENERATED, Mutant, code_lines, nth, spread

SWAPS = [(" > ", " >= ", "comparison"), (" < ", " <= ", "comparison"), (" >= ", " > ", "comparison"),
         (" <= ", " < ", "comparison"), (" == ", " != ", "comparison"), (" != ", " == ", "comparison"),
         ("hn::Gt(", "hn::Ge(", "comparison"), ("hn::Ge(", "hn::Gt(", "comparison"), ("hn::Le(", "hn::Lt(", "comparison"),
         ("hn::Lt(", "hn::Le(", "comparison"), ("hn::Eq(", "hn::Ne(", "comparison"), (" + ", " - ", "sign"),
         (" - ", " + ", "sign"), (" && ", " || ", "logic"), (" || ", " && ", "logic"),
         ("return true;", "return false;", "logic"), ("return false;", "return true;", "logic")]
# Not one that follows [ alone, an element by its number, nor one before >, a type's: what such changes do is seldom a
# programmer's mistake, and they are many.
NUMBER = re.compile(r"(?<![\w.'])(?!(?<=\[)\d+\])\d+(?![\w.'>])")
CONDITION = re.compile(r"\bif (\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)) ")
EARLY_END = re.compile(r"if .*\b(?:return|continue|break)\b.*;$")
STATEMENT = re.compile(r"(?!return\b|throw\b|using\b)(?:[\w:.\->\[\]*()]+ (?:[-+*|&^]?=) .*|[\w:.\->\[\]]+\(.*\)|(?:\+\+|--)[\w:.\->\[\]()]+);$")
WORDS = re.compile(r'"(?:[^"\\]|\\.)*"')


def masked(code):
    """The line with other letters for what stands in quotes: words are not changed."""
    return WORDS.sub(lambda found: '"' + "_" * (len(found.group()) - 2) + '"', code)


def alone(code, before):
    """Whether a line is a statement of its own, not a part of one."""
    return code.count("(") == code.count(")") and code.count("{") == code.count("}") and before.endswith((";", "{", "}", ")"))


def of_line(code, before):
    """(column, old, new, why) of all changes of a line; `before` is the line before it."""
    text = masked(code)
    loop = "for (" in text
    for old, new, why in SWAPS:
        if loop and why == "comparison":
            continue  # a loop without its end tells nothing
        at = text.find(old)
        while at >= 0:
            yield at, old, new, why
            at = text.find(old, at + 1)
    for found in NUMBER.finditer(text):
        yield found.start(), found.group(), str(int(found.group()) + 1), "number"
    for found in CONDITION.finditer(text):
        yield found.start(1), code[found.start(1):found.end(1)], f"(!{code[found.start(1):found.end(1)]})", "condition"
    start, stripped = len(code) - len(code.lstrip()), text.strip()
    if EARLY_END.match(stripped) and alone(stripped, before):
        yield start, code.strip(), ";", "early end"
    if STATEMENT.match(stripped) and alone(stripped, before):
        yield start, code.strip(), ";", "statement"


def room_mutants(folder, files, listed, count):
    """The listed mutants, then `count` generated ones, as many of each kind, evenly from all files; how many there are to
    generate; the texts."""
    texts = {file: (folder / file).read_text() for file in files}
    generated = []
    for file in files:
        before = ""
        for offset, code in code_lines(texts[file]):
            if "constexpr bool" not in code and "using " not in code:
                generated += [Mutant(file, offset + column, old, new, why, texts[file])
                              for column, old, new, why in of_line(code.rstrip(), before)]
            before = code.strip()
    kinds = zip_longest(*(spread([m for m in generated if m.why == why]) for why in GENERATED))
    chosen = [m for some in kinds for m in some if m][:count]
    return [Mutant(file, nth(texts[file], old, 0), old, new, why, texts[file])
            for file, old, new, why in listed] + chosen, len(generated), texts
