PYTHON ?= python3
BIN := .venv/bin
PEERS ?= $(BIN)/python

.PHONY: help demo test check format docs figures rooms bench tables clean

help:  ## print this menu
	@awk -F ':.*## ' '/^[a-z]+:.*## /{printf "make %-8s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

.venv/run: pyproject.toml
	$(PYTHON) -m venv .venv
	$(BIN)/pip install --quiet --disable-pip-version-check --editable .
	touch $@

.venv/dev: .venv/run
	$(BIN)/pip install --quiet --disable-pip-version-check --editable '.[test,check]'
	touch $@

demo: .venv/run  ## simulate a laser scan, mesh it, print the certificate, write mesh, picture and page to demo/
	$(BIN)/pointchart demo -o demo

test: .venv/dev  ## run all tests, in two processes, those of a file in the same one, which share a browser
	OPENBLAS_NUM_THREADS=1 $(BIN)/pytest -n 2 --dist loadfile

check: .venv/dev  ## format, lint, types, import contracts
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

format: .venv/dev  ## format and sort imports
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

bench: .venv/dev  ## time whole calls, stages, memory and start-up, in ten minutes; PEERS=PYTHON that has other programs
	$(BIN)/python benchmarks/speed.py --peers $(PEERS)
	$(BIN)/python benchmarks/startup.py

tables: .venv/dev  ## reproduce the paper's tables, measure boundaries, hard scans, creases and surfaces
	$(BIN)/python benchmarks/paper.py
	$(BIN)/python benchmarks/boundaries.py
	$(BIN)/python benchmarks/hard_scans.py
	$(BIN)/python benchmarks/creases.py
	$(BIN)/python benchmarks/surfaces.py

.venv/docs: .venv/run
	$(BIN)/pip install --quiet --disable-pip-version-check --editable '.[docs]'
	touch $@

docs: .venv/docs  ## build the site into build/docs, its examples run; warnings are errors
	$(BIN)/sphinx-build --quiet --fail-on-warning --keep-going -d build/doctrees docs build/docs
	@echo build/docs/index.html

figures: .venv/dev  ## draw the pictures of the docs
	$(BIN)/python benchmarks/figures.py docs/figures
	$(BIN)/python benchmarks/gallery.py docs/figures
	$(BIN)/python benchmarks/boundaries.py --picture docs/figures/boundary.png
	$(BIN)/python docs/pictures.py docs/figures
	$(BIN)/python docs/screenshots.py docs/figures
	$(BIN)/python docs/rooms.py

rooms: .venv/run  ## draw the rooms of the package from its imports, and write their tables, in docs/developers.md
	$(BIN)/python docs/rooms.py

clean:  ## remove everything that make has built
	rm -rf .venv demo build docs/examples
