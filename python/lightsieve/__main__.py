"""`python -m lightsieve` is the command line."""

from lightsieve.cli.main import main

if __name__ == "__main__":
    main()
