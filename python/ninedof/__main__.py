"""`python -m ninedof` is `ninedof`."""

from ninedof.cli import main

if __name__ == "__main__":
    main()
