"""Plain implementations to compare the library with: written to be obviously right, never to be fast."""
