"""Where the frozen programs begin: ``floorcast`` is the command line, ``floorcast-desktop`` the window."""

import multiprocessing
import sys
from pathlib import Path

from floorplan_core.packed_libraries import LinkBeforeImport

if __name__ == "__main__":
    sys.meta_path.insert(0, LinkBeforeImport(Path(sys._MEIPASS) / "packed"))  # before helper processes begin
    multiprocessing.freeze_support()
    if Path(sys.argv[0]).stem == "floorcast-desktop":
        sys.argv[1:1] = ["gui"]
    from floorplan_core.cli.main import main

    sys.exit(main())
