#!/bin/sh
# Runs the frozen program as its user would: no Python on the path, nothing of this checkout but the program.
set -eu
most=600 # MB
program=$(cd "$1" && pwd)
size=$(du -sm "$program" | cut -f1)
echo "$1: $size MB"
[ "$size" -lt $most ] || { echo "that is not under $most MB" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
survey=$program/_internal/floorcast_resources/sample_survey
cat > "$work/tour.py" <<'SCRIPT'
import os
out = os.environ["OUT"]
app.run("file.open", path=os.environ["SURVEY"])
app.picture(f"{out}/window.png")
app.run("correct.rename", region=app.workbench.plan.regions[0].id, name="Entrance")
app.run("file.export", path=f"{out}/edited.geojson")
app.run("file.export", path=f"{out}/edited.dxf")
app.run("file.save", path=f"{out}/edited.floorcast")
SCRIPT
run() { env -i HOME="$work" PATH=/nowhere LANG=C.UTF-8 "$@"; }
run "$program/floorcast" --version
run "$program/floorcast" plugins > /dev/null
run "$program/floorcast" plan "$survey" --out "$work/plan"
run OUT="$work" SURVEY="$survey" "$program/floorcast" gui --script "$work/tour.py"
grep -q '"name":"Entrance"\|"name": "Entrance"' "$work/edited.geojson"
for file in plan/plan.svg plan/plan.geojson plan/plan.png window.png edited.dxf edited.floorcast; do
    test -s "$work/$file" || { echo "the frozen program wrote no $file" >&2; exit 1; }
done
begun=$(date +%s%N)
run "$program/floorcast" --help > /dev/null
echo "--help in $(( ($(date +%s%N) - begun) / 1000000 )) ms"
echo "The program in $1 works."
