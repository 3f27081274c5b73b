"""The command line: one file per command.

A file `render.py` is the command `lightsieve render`, `exr_info.py` is `lightsieve exr info`. Each
defines `EXAMPLE`, `JSON` (the keys of the document that `--json` prints) and `command`; `main.py`
finds them, tools/generate_docs.py writes docs/cli.md from them. Names with a leading underscore
are helpers.

All of them are imported at every start, so they load the renderer only inside `command`.
"""
