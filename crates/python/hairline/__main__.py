"""`python -m hairline`: the program."""

from .program import main

main()
