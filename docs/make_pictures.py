"""Makes the pictures of docs/surveys.md and its table, which the README has too, from the surveys themselves;
and the parts of them that docs/limits.md shows (``picture_details.py``).

    .venv/bin/python docs/make_pictures.py [SURVEY ...]     all where none is named

Runs the commands that the pages show and changes nothing about their pictures but the size. Surveys other
than the bundled one are looked for in ``../shared/data`` beside the checkout; where one is absent its
pictures and its row stay as they are. ``plan.svg`` is drawn by ``rsvg-convert`` (Debian: librsvg2-bin).
"""

from __future__ import annotations

import json
import re
import resource
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from picture_details import draw_details
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
IMAGES = ROOT / "docs" / "images"
DATA = ROOT.parent / "shared" / "data"
SAMPLE = ROOT / "resources" / "sample_survey"
FLOORCAST = Path(sys.executable).parent / "floorcast"
PAGES = (ROOT / "README.md", ROOT / "docs" / "surveys.md")
TABLE = re.compile(r"(<!-- table: docs/make_pictures\.py -->\n).*?(<!-- end of table -->)", re.DOTALL)
HEADER = (
    "| survey | rooms, corridors, doors | area, of it predicted | rooms found, mean IoU "
    "| dimensions, mean error | doors, precision and recall | CPU |\n"
    "| --- | --- | --- | --- | --- | --- | --- |\n"
)
LARGEST = 1200  # pixels of a side
MOST_BYTES = 200_000  # of a picture on a page
SIZES = ((LARGEST, 128), (LARGEST, 24), (1000, 16), (800, 16))  # pixels and colours, the first that is small
FIGURES = ("planes", "occupancy", "plan")
EVERY = 40  # seconds of run time between two frames of the film strip


@dataclass(frozen=True)
class Survey:
    """One survey: what the commands are given."""

    name: str  # of its pictures
    title: str
    source: Path
    options: tuple[str, ...] = ()
    truth: Path | None = None
    figures: tuple[str, ...] = FIGURES


def extruded(name: str) -> tuple[Path, tuple[str, ...]]:
    """The lifted cloud of a planar laser run, and its trajectory."""
    folder = DATA / name
    return folder / "points3d_extruded.ply", ("--trajectory", str(folder / "trajectory3d.tum"))


SURVEYS = (
    Survey("sample", "bundled survey", SAMPLE, truth=SAMPLE / "truth.json"),
    Survey("hospital", "hospital floor", DATA / "sim_aws_hospital" / "points.ply",
           truth=DATA / "sim_aws_hospital" / "gt_plan.json"),
    Survey("duplex", "duplex house", DATA / "sim_ifc_duplex_L1" / "points.ply",
           truth=DATA / "sim_ifc_duplex_L1" / "gt_ifc.json"),
    Survey("house", "open-plan house", DATA / "sim_aws_small_house" / "points.ply",
           truth=DATA / "sim_aws_small_house" / "gt_plan.json", figures=("plan",)),
    Survey("fr079", "Freiburg 079 (real)", DATA / "octomap_fr079_3d" / "points.ply",
           truth=DATA / "octomap_fr079_3d" / "free_voxels.npz"),
    Survey("fr079-octomap", "Freiburg 079, OctoMap (real)", DATA / "octomap_fr079_3d" / "geb079.bt",
           truth=DATA / "octomap_fr079_3d" / "free_voxels.npz", figures=("occupancy", "plan")),
    Survey("intel", "Intel lab (real)", *extruded("carmen_intel")),
    Survey("seattle", "Seattle (real)", *extruded("carmen_seattle")),
    Survey("aces", "ACES (real)", *extruded("carmen_aces")),
    Survey("intel-map", "Intel lab, grid map (real)", DATA / "maps_room_segmentation" / "lab_intel.png",
           ("--resolution", "0.05"), figures=("plan",)),
)  # fmt: skip


def main(names: list[str]) -> int:
    """Make the pictures of the surveys named, and their rows in the tables."""
    rows = {}
    with tempfile.TemporaryDirectory() as folder:
        for survey in SURVEYS:
            if survey.source.exists() and (not names or survey.name in names):
                rows[survey.title] = run(survey, Path(folder) / survey.name)
    for page in PAGES:
        page.write_text(with_rows(page.read_text(encoding="utf-8"), rows), encoding="utf-8")
    return 0


def run(survey: Survey, out: Path) -> str:
    """Plan one survey, keep its pictures; returns its row of the table."""
    before = cpu()
    call("plan", survey.source, *survey.options, "--out", out, "--json")
    seconds = cpu() - before
    for figure in survey.figures:
        shrink(out / f"{figure}.png", IMAGES / f"{survey.name}-{figure}.png")
    draw_details(survey.name, out, survey.truth, IMAGES)
    if survey.source == SAMPLE:
        extra_pictures(out)
    score = json.loads(call("evaluate", out, survey.truth, "--json")) if survey.truth else {}
    plan = json.loads((out / "plan.geojson").read_text(encoding="utf-8"))
    return row(survey.title, [f["properties"] for f in plan["features"]], score, seconds)


def extra_pictures(out: Path) -> None:
    """The drawing of the bundled survey, and the film strip of its run."""
    drawn = out / "drawing.png"
    subprocess.run(["rsvg-convert", "-w", str(LARGEST), out / "plan.svg", "-o", drawn], check=True)
    shrink(drawn, IMAGES / "sample-drawing.png")
    call("watch", SAMPLE, "--every", EVERY, "--out", out / "run")
    shrink(out / "run" / "filmstrip.png", IMAGES / "sample-filmstrip.png")


def cpu() -> float:
    """CPU seconds of all commands so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def call(*arguments: Any) -> str:
    """What one command of floorcast prints."""
    done = subprocess.run([FLOORCAST, *map(str, arguments)], check=True, stdout=subprocess.PIPE, text=True)
    return done.stdout


def shrink(picture: Path, target: Path) -> None:
    """A copy of a picture, small enough for a page, in the colours that the picture has most of."""
    whole = Image.open(picture).convert("RGB")
    for side, colours in SIZES:
        image = whole.copy()
        image.thumbnail((side, side), Image.Resampling.LANCZOS)
        with_colours(image, palette(whole, colours)).save(target, optimize=True)
        if target.stat().st_size < MOST_BYTES:
            return


def palette(image: Image.Image, colours: int) -> NDArray[np.int64]:
    """(K, 3) the most frequent colours of an image."""
    counted = image.getcolors(image.width * image.height) or []
    most = sorted(counted, key=lambda pair: (-pair[0], pair[1]))[:colours]
    return np.array([colour for _, colour in most], dtype=np.int64)


def with_colours(image: Image.Image, colours: NDArray[np.int64]) -> Image.Image:
    """The image in the nearest of the given colours; Pillow itself looks for them roughly and tints white."""
    pixels = np.asarray(image, dtype=np.int64).reshape(-1, 3)
    own, which = np.unique(pixels @ np.array([65536, 256, 1]), return_inverse=True)
    channels = np.column_stack([own >> 16, (own >> 8) & 255, own & 255])
    nearest = np.concatenate(
        [((part[:, None] - colours) ** 2).sum(axis=2).argmin(axis=1) for part in np.array_split(channels, 64)]
    )
    out = Image.fromarray(nearest[which].astype(np.uint8).reshape(image.height, image.width), mode="P")
    out.putpalette(colours.astype(np.uint8).tobytes())
    return out


def row(title: str, features: list[dict[str, Any]], score: dict[str, Any], seconds: float) -> str:
    """One row of the table."""
    regions = [f for f in features if f["kind"] == "region"]
    labels = [region["label"] for region in regions]
    doors = sum(f["kind"] == "door" for f in features)
    area = sum(region["area_m2"] for region in regions)
    guessed = sum(region["area_m2"] * region["speculated_fraction"] for region in regions)
    cells = (
        title,
        f"{labels.count('room')}, {labels.count('corridor')}, {doors}",
        f"{area:.0f} m², {guessed / area:.0%}",
        found_rooms(score),
        found_dimensions(score.get("dimensions")),
        found_doors(score.get("doors")),
        f"{seconds:.1f} s",
    )
    return f"| {' | '.join(cells)} |\n"


def found_rooms(score: dict[str, Any]) -> str:
    """Rooms found of those expected; where only free space is known, its precision and recall."""
    rooms, free = score.get("rooms"), score.get("free_space")
    if rooms:
        return f"{rooms['found']} of {rooms['rooms']}, {rooms['mean_iou']:.3f}"
    return f"free space {free['precision']:.2f}, {free['recall']:.2f}" if free else "–"


def found_dimensions(dimensions: dict[str, Any] | None) -> str:
    """Mean error of those that could be measured."""
    if not dimensions:
        return "–"
    return f"{100 * dimensions['mean_m']:.1f} cm ({dimensions['measured']} of {dimensions['total']})"


def found_doors(doors: dict[str, Any] | None) -> str:
    """Precision and recall of the doors."""
    return f"{doors['precision']:.2f}, {doors['recall']:.2f}" if doors and doors["required"] else "–"


def with_rows(text: str, rows: dict[str, str]) -> str:
    """The page with new rows for some surveys; the others keep theirs."""

    def table(found: re.Match[str]) -> str:
        old = {line.split("|")[1].strip(): line + "\n" for line in body_lines(found.group(0).splitlines())}
        kept = [rows.get(s.title) or old.get(s.title, "") for s in SURVEYS]
        return found.group(1) + HEADER + "".join(kept) + found.group(2)

    return TABLE.sub(table, text)


def body_lines(lines: Iterable[str]) -> list[str]:
    """Rows of a table without its two header lines."""
    return [line for line in lines if line.startswith("|")][2:]


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
