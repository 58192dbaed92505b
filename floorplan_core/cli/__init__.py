"""The command line."""

# Here, since it has to be in memory before there is none left to load it into.
NO_MEMORY = "There is not enough memory for this; close other programs, or thin the input."
