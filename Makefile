# Everything sets itself up in .venv; needs Python 3.11 or newer and make. `make help` lists the targets.
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
DEMO := demo-plan
WORKERS ?= 2

.PHONY: help setup demo test check format bench bench-ui bench-io fuzz accuracy app app-test docs clean
.DEFAULT_GOAL := help

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## /  make \1\t/p' Makefile | expand -t 18

setup: $(READY) ## the environment in .venv, with the system libraries it needs

$(READY): pyproject.toml tools/set_up.sh tools/set_up.py
	@sh tools/set_up.sh $(VENV)
	@touch $@

demo: $(READY) ## a floor plan of the bundled survey
	$(BIN)/floorcast plan resources/sample_survey --out $(DEMO)

test: $(READY) ## the whole test suite, offscreen
	QT_QPA_PLATFORM=offscreen $(BIN)/python -m pytest --numprocesses $(WORKERS) --dist loadfile

check: $(READY) ## lint, format, types, architecture
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-cache

format: $(READY) ## put the code into the house format
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

bench: $(READY) ## stage times beside the time to read, growth, greedy against optimal
	$(BIN)/python -m benchmarks

bench-io: $(READY) ## reading and planning large files beside plain reading: MB/s and most memory
	$(BIN)/python -m benchmarks.bench_io

fuzz: $(READY) ## damaged files of every format: a survey or one sentence, never a crash; minutes
	$(BIN)/python -m benchmarks.fuzz

accuracy: $(READY) ## plans of surveys with known truth, measured
	$(BIN)/python -m benchmarks.accuracy

bench-ui: $(READY) ## how long the window ever stands still while a big survey loads and plans
	QT_QPA_PLATFORM=offscreen $(BIN)/python -m benchmarks.ui

app: $(READY) ## the program in one folder, dist/floorcast, to hand out
	rm -rf build/site
	$(BIN)/python -m pip --disable-pip-version-check install --quiet --no-deps --target build/site .
	$(BIN)/pyinstaller --noconfirm --log-level ERROR --distpath dist --workpath build/pyinstaller build_app.spec
	@du -sm dist/floorcast | sed 's/\([0-9]*\).*/dist\/floorcast: \1 MB/'

app-test: ## the program of `make app` on the bundled survey, with no Python to be found
	sh tools/app_test.sh dist/floorcast

docs: $(READY) ## pages that are written from the code
	$(BIN)/floorcast settings --markdown > docs/settings.md

clean: ## remove what make made
	rm -rf $(VENV) $(DEMO) build dist
