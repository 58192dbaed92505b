"""Plain implementations that the library is compared with: written to be obviously right, never to be fast."""
