"""Where surveys are read and planned: in this process, or in one of its own beside the window. No Qt."""
