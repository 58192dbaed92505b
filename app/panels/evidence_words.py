"""The stages' words of evidence as sentences. No Qt."""

from __future__ import annotations

EVIDENCE = {
    "open": "Rays crossed the wall here",
    "passage": "Free space runs through it",
    "path": "The sensor went through it",
    "lintel": "Wall was seen above it",
    "wall on both sides": "Wall was seen on both sides of it",
    "corner": "Wall was seen on one side of it, the other is a corner",
    "both faces": "It was seen from both sides of the wall",
    "shut": "A shut leaf closes it",
    "recess": "Its leaf stands back from the wall",
    "both wall ends": "The wall ends freely on both sides of it",
    "free passage": "Nothing stands in it",
    "by hand": "A person says so",
    "corridor opens into a hall": "A corridor opens into a hall",
    "narrow between two spaces": "It is narrow between two wide spaces",
    "reaches ceiling": "It reaches the ceiling",
    "looked over": "The sensor looked over it: there is air above",
    "hardly seen": "Too little of its height was seen",
    "above furniture": "It reaches above furniture",
    "long, top not seen": "It is long, and its top was not seen",
    "low": "It is low",
    "other face of a wall": "It is the other face of a wall",
    "in line with a wall": "It lies in line with a wall",
    "straight boundary of free space": "Free space ends there along a straight line",
}
