# From a fresh Debian 12 to a picture: `make demo`; to a tested build: `make test`. Each step runs once and again only
# when what it depends on has changed.
#
#   make setup     .venv/bin/lightsieve and the Python package `lightsieve` in .venv
#   make demo      renders scenes/showcase.ass with every built-in AOV to out/showcase.exr and out/showcase.png
#   make test      all tests but the very long ones
#   make bigtest   the very long ones
#   make bench     how fast it renders, what it takes, what AOVs cost: a few minutes; bench/README.md explains the tables
#   make format    rewrites C++ and Python in the project's style;  make lint  checks it
#   make docs      rewrites the pages that follow from the code;  make stubs  the modules' types
#   NATIVE=1       uses every instruction of this processor; the result does not run on older ones

.DELETE_ON_ERROR:
SHELL := /bin/sh
PYTHON ?= python3
NATIVE ?= 0
VENV := .venv
BIN := $(VENV)/bin
BUILD := build/release
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet

cpp_sources := CMakeLists.txt $(shell find src include -type f 2>/dev/null)
python_sources := $(shell find python -name '*.py' -o -name '*.pyi' 2>/dev/null)
native := $(if $(filter 1 ON on yes,$(NATIVE)),ON,OFF)
cmake_options := -C build-dir=$(BUILD) -C cmake.define.LIGHTSIEVE_TESTS=ON -C cmake.define.LIGHTSIEVE_NATIVE=$(native)

.PHONY: setup demo test bigtest bench packages dev cpp_tests stubs docs format lint clean
setup: $(VENV)/.installed

# The distribution's packages: a look at the list when they are all there.
packages:
	@tools/install-packages

# The virtual environment with the tools of the build, in the versions of constraints.txt.
$(VENV)/.build_tools: constraints.txt pyproject.toml | packages
	$(PYTHON) -m venv $(VENV)
	$(PIP) install -c constraints.txt pip scikit-build-core nanobind
	@touch $@

# Compiles and installs. Editable: the .py files are used in place. The build directory stays, so that a change
# compiles only what it touches. A change of NATIVE counts as a change.
$(VENV)/.installed: $(VENV)/.build_tools $(VENV)/.native_$(native) $(cpp_sources) $(python_sources)
	$(PIP) install -c constraints.txt --no-build-isolation $(cmake_options) -e .
	@touch $@
$(VENV)/.native_$(native): $(VENV)/.build_tools
	@rm -f $(VENV)/.native_*
	@touch $@

# What only the tests need.
dev: $(VENV)/.dev
$(VENV)/.dev: $(VENV)/.installed constraints.txt pyproject.toml
	@$(BIN)/python -c 'import tomllib; print(*tomllib.load(open("pyproject.toml", "rb"))["project"]["optional-dependencies"]["dev"], sep="\n")' > $@.txt
	$(PIP) install -c constraints.txt -r $@.txt
	@touch $@

demo: out/showcase.png
	@echo "layers: $(CURDIR)/out/showcase.exr"
	@echo "sheet:  $(CURDIR)/out/showcase.png"
out/showcase.exr: scenes/showcase.ass $(VENV)/.installed
	@mkdir -p out
	$(BIN)/lightsieve render scenes/showcase.ass -o $@
out/showcase.png: out/showcase.exr
	$(BIN)/lightsieve exr sheet $< -o $@

cpp_tests: setup
	cmake --build $(BUILD)

test: dev cpp_tests
	ctest --test-dir $(BUILD) --output-on-failure -j 2
	$(BIN)/python -m pytest -n 2 -m "not big"

bigtest: dev cpp_tests
	$(BIN)/python -m pytest -m big

bench: setup
	$(BIN)/python bench/render_bench.py

# What follows from the code: the modules' type stubs and the generated pages.
stubs: dev
	tools/stubs
docs: dev
	$(BIN)/python tools/generate_docs.py

format: dev
	tools/format
lint: dev
	tools/format --check

clean:
	rm -rf build out $(VENV)
