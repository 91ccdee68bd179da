"""The compiled part is private: the package gives types to all that users see, and these are what it needs for that."""

from typing import Any, NoReturn

version: str
has_audit: bool

class Error(ValueError):
    code: str
    what: str
    file: str
    line: int
    expected: str
    found: str
    remedy: str
    subject: str

def fail(code: str, what: str, expected: str = ..., found: str = ..., remedy: str = ...) -> NoReturn: ...
def __getattr__(name: str) -> Any: ...
