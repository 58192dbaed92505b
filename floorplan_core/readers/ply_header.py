"""The header of a PLY file (Greg Turk, 1994): elements, their properties, and where the data begins."""

from __future__ import annotations

from dataclasses import dataclass, field

from floorplan_core.errors import InputError

MAX_HEADER_BYTES = 1 << 20  # longer headers are comments gone wrong, or not PLY at all
MAX_COUNT = 1 << 53  # larger counts cannot be meant
TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2",
    "ushort": "u2", "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8", "int64": "i8", "uint64": "u8",
}  # fmt: skip
FORMATS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


@dataclass(frozen=True)
class PlyProperty:
    """One property; ``count_type`` is set where it is a list."""

    name: str
    type: str  # numpy code without byte order: "f4"
    count_type: str | None = None


@dataclass
class PlyElement:
    """One element: its name, how many, and what each has."""

    name: str
    count: int
    properties: list[PlyProperty] = field(default_factory=list)

    @property
    def has_lists(self) -> bool:
        """True where its records differ in size."""
        return any(p.count_type for p in self.properties)


@dataclass(frozen=True)
class PlyHeader:
    """A parsed header."""

    byte_order: str  # "<", ">", or "" for text
    elements: tuple[PlyElement, ...]
    size: int  # bytes up to the first byte of data

    def element(self, name: str) -> PlyElement | None:
        """The element of that name, or None."""
        return next((e for e in self.elements if e.name == name), None)


def parse_ply_header(head: bytes, name: str) -> PlyHeader:
    """Parse the first bytes of a PLY file; :class:`InputError` names the line that is wrong."""
    lines, size = _header_lines(head, name)
    byte_order: str | None = None
    elements: list[PlyElement] = []
    for number, line in lines:
        words = line.split()
        try:
            if words[:1] == ["format"]:
                byte_order = FORMATS[words[1]]
            elif words[:1] == ["element"]:
                elements.append(PlyElement(words[1], _count(words[2])))
            elif words[:1] == ["property"]:
                elements[-1].properties.append(_property(words))
            elif words and words[0] not in ("comment", "obj_info", "ply"):
                raise KeyError(words[0])
        except (KeyError, IndexError, ValueError):
            raise InputError(
                f"{name} claims to be PLY but line {number} of its header is not valid: {line[:60]!r}."
            ) from None
    if byte_order is None:
        raise InputError(f"{name} claims to be PLY but its header has no 'format' line.")
    return PlyHeader(byte_order, tuple(elements), size)


def _header_lines(head: bytes, name: str) -> tuple[list[tuple[int, str]], int]:
    """Numbered lines between 'ply' and 'end_header', and the bytes that they take."""
    lines: list[tuple[int, str]] = []
    start = 0
    while True:
        end = head.find(b"\n", start)
        if end < 0:
            end = head.find(b"\r", start)  # old Macintosh line ends
        if end < 0:
            raise InputError(
                f"{name} claims to be PLY but its header does not end ('end_header' is missing)."
            )
        line = head[start:end].decode("latin-1").strip()
        start = end + 1
        if line == "end_header":
            return lines, start
        lines.append((len(lines) + 1, line))


def _count(word: str) -> int:
    count = int(word)
    if not 0 <= count <= MAX_COUNT:
        raise ValueError(word)
    return count


def _property(words: list[str]) -> PlyProperty:
    if words[1] == "list":
        return PlyProperty(words[4], TYPES[words[3]], TYPES[words[2]])
    return PlyProperty(words[2], TYPES[words[1]])
