"""Text: separators, decimal commas, headers, counts, comments and columns that are no numbers."""

from __future__ import annotations

import numpy as np
import pytest

from floorplan_core.config import InputConfig
from floorplan_core.errors import InputError
from floorplan_core.readers import open_survey
from tests.plugins.plugin_files import peak_memory
from tests.readers.reader_clouds import Remembering, all_points, room

AS_IT_IS = InputConfig(unit="m", up="z")


@pytest.fixture
def cloud():
    return np.round(room(np.random.default_rng(4), density=8), 4)


def lines(cloud, separator, decimal=".", extra=""):
    rows = (separator.join(f"{v:.4f}".replace(".", decimal) for v in p) + extra for p in cloud)
    return "\n".join(rows) + "\n"


@pytest.mark.parametrize(
    ("name", "make"),
    [
        ("a.xyz", lambda c: lines(c, " ")),
        ("a.txt", lambda c: lines(c, "\t")),
        ("a.csv", lambda c: lines(c, ",")),
        ("a.csv", lambda c: lines(c, ", ")),
        ("a.csv", lambda c: "x,y,z\n" + lines(c, ",")),
        ("a.csv", lambda c: "X;Y;Z;Class\n" + lines(c, ";", ",", ";wall")),
        ("a.csv", lambda c: lines(c, ";")),
        ("a.txt", lambda c: lines(c, " ", ",")),
        ("a.asc", lambda c: "//X Y Z R G B\n" + lines(c, " ", extra=" 10 20 30")),
        ("a.pts", lambda c: f"{len(c)}\n" + lines(c, " ", extra=" -1200 10 20 30")),
        ("a.pts", lambda c: lines(c, " ").replace("\n", "\r\n")),
        ("a.xyz", lambda c: "# a comment\n\n" + lines(c, "  ") + "\n\n"),
        ("a.xyz", lambda c: "\ufeff" + lines(c, " ")),
        ("a.xyz", lambda c: lines(c, " ").rstrip("\n")),
        ("a.unknown", lambda c: lines(c, " ")),
        ("a.csv", lambda c: "X [m],Y [m],Z [m],Grey\n" + lines(c, ",", extra=",7")),
        ("a.csv", lambda c: '"x","y","z"\n"' + lines(c, '","', extra='"').replace("\n", '\n"')[:-1]),
        ("a.csv", lambda c: '"x";"y"\n"' + lines(c, '";"', ",", '"').replace("\n", '\n"')[:-1]),
        (
            "a.csv",
            lambda c: "Punkt;Rechtswert;Hochwert;Höhe (m)\n7;" + lines(c, ";").replace("\n", "\n7;")[:-2],
        ),
        ("a.txt", lambda c: "Project: Büro\nDate: 1 May\n\nA B C\n" + lines(c, "\t")),
    ],
)
def test_round_trip(tmp_path, cloud, name, make):
    path = tmp_path / name
    path.write_text(make(cloud), encoding="utf-8", newline="")
    points, _ = all_points(open_survey(path, config=AS_IT_IS))
    assert len(points) == len(cloud)
    np.testing.assert_allclose(points, cloud, atol=1e-5)


def test_columns_without_known_names_are_said(tmp_path, cloud):
    """In the code page of Windows, too; in a file that is not named like a cloud they are no cloud."""
    text = "Länge;Breite;Höhe\n" + lines(cloud, ";", ",")
    path = tmp_path / "a.csv"
    path.write_text(text, encoding="cp1252")
    survey = open_survey(path, config=AS_IT_IS)
    np.testing.assert_allclose(all_points(survey)[0], cloud, atol=1e-5)
    assert "The first three columns of a.csv are taken as x, y and z." in survey.assumptions
    other = path.rename(tmp_path / "a.log")
    with pytest.raises(InputError, match="not a point cloud"):
        open_survey(other)


def test_decimal_commas_between_quotes_and_commas_are_not_guessed(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text('"1,5","2,5","3,5"\n' * 9)
    with pytest.raises(InputError, match="its content is not"):
        open_survey(path)


def test_columns_by_name(tmp_path, cloud):
    path = tmp_path / "named.csv"
    rows = (f"{k // 5},{p[2]},{p[0]},{p[1]},{0.5 * k}" for k, p in enumerate(cloud))
    path.write_text("scan_id,z,x,y,time\n" + "\n".join(rows))
    survey = open_survey(path, config=AS_IT_IS)
    points, ids = all_points(survey)
    np.testing.assert_allclose(points, cloud, atol=1e-5)
    np.testing.assert_array_equal(ids, np.arange(len(cloud)) // 5)
    stamps = np.concatenate([c.stamps for c in survey.chunks()])
    np.testing.assert_allclose(stamps, 0.5 * np.arange(len(cloud)))


def test_lines_that_are_no_points_are_counted(tmp_path, cloud):
    path = tmp_path / "dirty.xyz"
    path.write_text(lines(cloud[:50], " ") + "1 2\nhello there world\n" + lines(cloud[50:], " "))
    seen = Remembering()
    points, _ = all_points(open_survey(path, config=AS_IT_IS, observer=seen))
    assert len(points) == len(cloud)
    assert any("2 lines of dirty.xyz hold no point" in w for w in seen.warnings)


def test_a_line_without_end_costs_no_memory_and_not_what_follows(tmp_path, cloud):
    path = tmp_path / "a.xyz"
    path.write_text(lines(cloud[:9], " ") + "1 " * (20 << 20) + "\n" + lines(cloud[9:], " "))
    before = peak_memory(reset=True)
    points, _ = all_points(open_survey(path, config=AS_IT_IS))
    assert peak_memory() - before < 100 << 20
    assert len(cloud) <= len(points) <= len(cloud) + 20  # a piece of it may look like a point
    np.testing.assert_allclose(points[-len(cloud) + 9 :], cloud[9:], atol=1e-5)


def test_a_large_file_is_read_in_blocks(tmp_path, cloud, monkeypatch):
    from floorplan_core.readers import text_rows

    monkeypatch.setattr(text_rows, "BLOCK_BYTES", 777)
    path = tmp_path / "a.xyz"
    path.write_text(lines(cloud, " "))
    survey = open_survey(path, config=AS_IT_IS)
    assert sum(1 for _ in survey.chunks()) > 10
    np.testing.assert_allclose(all_points(survey)[0], cloud, atol=1e-5)


@pytest.mark.parametrize(
    "text", ["just some words\nand more words\nof no use\n", "1 2\n3 4\n5 6\n", "\n\n\n"]
)
def test_text_that_is_no_cloud(tmp_path, text):
    path = tmp_path / "notes.txt"
    path.write_text(text)
    with pytest.raises(InputError, match=r"notes.txt"):
        open_survey(path)


def test_a_trajectory_is_no_cloud(tmp_path):
    path = tmp_path / "trajectory.tum"
    path.write_text("0 1 2 3 0 0 0 1\n" * 20)
    with pytest.raises(InputError, match="is a trajectory, not a point cloud"):
        open_survey(path)


@pytest.mark.parametrize("count", [300, 20_000])  # one for each parser
@pytest.mark.parametrize(
    ("separator", "decimal", "name"),
    [(",", ".", "p{}"), (";", ",", "corner {} a"), (";", ".", ""), ("\t", ".", "p{}")],
)
def test_points_with_names(tmp_path, count, separator, decimal, name):
    """As total stations export them: a name, the coordinates, a code."""
    cloud = np.round(room(np.random.default_rng(4), density=400)[:count], 4)
    head = separator.join(["Name", "Easting", "Northing", "Elevation", "Code"])
    rows = [
        separator.join([name.format(k), *(f"{v:.4f}".replace(".", decimal) for v in p), "wall"])
        for k, p in enumerate(cloud)
    ]
    rows[0] = rows[0] if name else "x" + rows[0]
    path = tmp_path / "a.csv"
    path.write_text("\n".join([head, *rows]) + "\n")
    points, _ = all_points(open_survey(path, config=AS_IT_IS))
    np.testing.assert_allclose(points, cloud, atol=1e-4)


def test_words_before_numbers_need_names_of_columns(tmp_path, cloud):
    path = tmp_path / "a.csv"
    path.write_text("".join(f"p,{line}\n" for line in lines(cloud, ",").splitlines()))
    with pytest.raises(InputError):
        open_survey(path, config=AS_IT_IS)
