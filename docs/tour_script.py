"""Makes the pictures of docs/tour.md: ``floorcast gui --script docs/tour_script.py``.

``app`` is what every script gets. Nothing here needs a display.
"""

from pathlib import Path

IMAGES = Path(__file__).resolve().parent / "images"
SIZE = {"width": 1440, "height": 900}
app = globals()["app"]


def picture(name, **arguments):
    app.picture(IMAGES / f"tour-{name}.png", **{**SIZE, **arguments})


def largest(label):
    return max((r for r in app.workbench.plan.regions if r.label == label), key=lambda r: r.area)


def select(kind, thing):
    from floorcast_app.selection import Item

    app.workbench.selection.select(Item(kind, thing.id))


picture("start")

app.run("file.open_sample")
picture("inspect")

door = max(app.workbench.plan.doors, key=lambda d: d.confidence)
select("door", door)
app.run("view.pane", pane="evidence")
picture("door")
app.workbench.selection.select(None)

room = largest("room")
app.run("correct.rename", region=room.id, name="Library")
corridor = largest("corridor")
app.run("correct.relabel", region=corridor.id, label="lobby")
x0, y0, x1, y1 = largest("room").polygon.bounds
middle = y0 + 0.2 * (y1 - y0)  # beside the name of the room
app.run("measure.add", start=[x0, middle], end=[x1, middle], measured=round(x1 - x0, 2))
app.run("view.plan")
app.run("view.pane", pane="ground_truth")
app.run("view.fit")
picture("correct")

app.run("edit.undo")
app.run("edit.undo")
app.run("edit.undo")
app.run("plan.replay", every=60)
app.run("view.theme")
app.run("view.run")
app.run("view.fit")
picture("run")

app.run("view.theme")
app.run("view.inspect")
