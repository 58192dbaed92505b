#!/bin/sh
# Finds a Python that Floorcast runs on and lets it do the rest: tools/set_up.py.
set -eu
here=$(dirname "$0")
for name in ${PYTHON:-} python3.13 python3.12 python3.11 python3; do
    # A name may exist and yet not run (version managers leave such stubs): ask it.
    if "$name" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 14))' >/dev/null 2>&1; then
        exec "$name" "$here/set_up.py" "$@"
    fi
done
echo "Floorcast needs Python 3.11 to 3.14; install one (Debian and Ubuntu: sudo apt-get install python3 python3-venv) and run make again." >&2
exit 1
