"""`python -m ninedof` is `ninedof`."""

from ninedof.cli.app import main

if __name__ == "__main__":
    main()
