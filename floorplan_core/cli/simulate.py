"""``floorcast simulate``: a synthetic survey with its truth."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from floorplan_core.cli.console import Console
from floorplan_core.cli.options import DebugFlag, JsonFlag, OutFolder, QuietFlag

if TYPE_CHECKING:
    from floorplan_core.simulation import SurveyPaths, SurveySpec

SensorField = Annotated[
    list[str] | None,
    typer.Option(
        "--sensor-set", metavar="FIELD=VALUE", help="Change one field of the sensor; may be repeated."
    ),
]
BuildingField = Annotated[
    list[str] | None,
    typer.Option(
        "--building-set", metavar="FIELD=VALUE", help="Change one field of the building; may be repeated."
    ),
]


def simulate(
    context: typer.Context,
    out: OutFolder,
    seed: Annotated[int, typer.Option(help="Seed of all random numbers; the same seed, the same bytes.")] = 0,
    style: Annotated[str, typer.Option(help="straight, l, t, ring, grid or flat.")] = "straight",
    rooms: Annotated[int, typer.Option(help="Number of rooms, roughly.")] = 12,
    sensor: Annotated[str, typer.Option(help="lidar, camera, station, tilted or planar.")] = "lidar",
    furniture: Annotated[str, typer.Option(help="none, normal or heavy.")] = "normal",
    explore: Annotated[float, typer.Option(help="Share of the reachable rooms that are entered.")] = 1.0,
    noise: Annotated[
        float | None, typer.Option(help="Standard deviation of a range, m.", show_default="the sensor's")
    ] = None,
    drift: Annotated[float, typer.Option(help="Largest error of an estimated position, m.")] = 0.0,
    yaw: Annotated[
        float | None, typer.Option(help="Of the building in the world, degrees.", show_default="drawn")
    ] = None,
    roll: Annotated[float, typer.Option(help="Tilt of the world about x, degrees.")] = 0.0,
    pitch: Annotated[float, typer.Option(help="Tilt of the world about y, degrees.")] = 0.0,
    offset: Annotated[tuple[float, float, float], typer.Option(help="Shift of the world, m.")] = (0, 0, 0),
    points: Annotated[int, typer.Option(help="More points than this are dropped.")] = 1_000_000,
    thin: Annotated[float, typer.Option(help="Thinning voxel, m; 0 keeps all points.")] = 0.025,
    building_set: BuildingField = None,
    sensor_set: SensorField = None,
    as_json: JsonFlag = False,
    quiet: QuietFlag = False,
    debug: DebugFlag = False,
) -> None:
    """Simulate a survey: points.ply, trajectory.tum, trajectory_gt.tum and truth.json."""
    from floorplan_core.simulation import BuildingSpec, SurveySpec, sensor_preset
    from floorplan_core.simulation import simulate as simulate_files

    console = Console(context, as_json=as_json, quiet=quiet)
    errors = {} if noise is None else {"noise": noise}
    building = {"style": style, "rooms": rooms, "furniture": furniture}
    spec = SurveySpec(
        building=BuildingSpec(**{**building, **_fields(BuildingSpec, "--building-set", building_set)}),
        sensor=sensor_preset(
            sensor, **{**errors, **_fields(type(sensor_preset("lidar")), "--sensor-set", sensor_set)}
        ),
        seed=seed,
        explore=explore,
        drift=drift,
        yaw_deg=yaw,
        roll_deg=roll,
        pitch_deg=pitch,
        offset_x=offset[0],
        offset_y=offset[1],
        offset_z=offset[2],
        max_points=points,
        thin=thin,
    )
    with console.observer() as observer:
        paths = simulate_files(spec, out, observer)
    console.result(_summary(paths, spec), _text(paths))


def _fields(spec: type, option: str, assignments: list[str] | None) -> dict[str, Any]:
    """``FIELD=VALUE`` texts as arguments of ``spec``, numbers where the field holds numbers."""
    from dataclasses import fields

    from floorplan_core.errors import UsageError

    known = {f.name: f for f in fields(spec)}
    values: dict[str, Any] = {}
    for text in assignments or ():
        name, equals, value = text.partition("=")
        if not equals or name not in known:
            raise UsageError(f"{option} needs FIELD=VALUE with one of {', '.join(known)} (given {text!r}).")
        values[name] = value if "choices" in known[name].metadata else _number(name, value, known[name].type)
    return values


def _number(name: str, text: str, kind: object) -> float:
    from floorplan_core.errors import UsageError

    try:
        return int(text) if kind == "int" else float(text)
    except ValueError as error:
        raise UsageError(f"{name} must be a number (given {text!r}).") from error


def _summary(paths: SurveyPaths, spec: SurveySpec) -> dict[str, Any]:
    names = ("points", "trajectory", "trajectory_gt", "truth")
    return {"seed": spec.seed, "files": {name: str(getattr(paths, name)) for name in names}}


def _text(paths: SurveyPaths) -> str:
    files = (paths.points, paths.trajectory, paths.trajectory_gt, paths.truth)
    return "\n".join(f"wrote {path}" for path in files)
