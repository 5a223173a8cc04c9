# Needs python3 and make, nothing else: the first call of any target makes .venv from requirements.lock.

PYTHON ?= python3
SCENE ?=
WORKERS ?= 2
BIN := .venv/bin/

# A law by its number must not find the others that begin alike: L1 is L1_, not L10_.
ifneq ($(filter L1 L2 L3 L4 L5 L6 L7 L8 L9 L10 L11 L12 L13 L14 L15,$(LAW)),)
ONLY := -k "$(LAW)_"
else ifneq ($(LAW),)
ONLY := -k "$(LAW)"
endif

export PIP_DISABLE_PIP_VERSION_CHECK := 1

.DEFAULT_GOAL := help
.PHONY: help play test test-long test-all bench fmt lock clean venv

help:  ## list the targets
	@awk -F ': .*## ' '/^[a-z-]+: .*## / { printf "  make %-10s %s\n", $$1, $$2 }' Makefile

play: venv  ## the game, in this terminal (SCENE=field-storm for a scene)
	@$(BIN)fasteroids play $(if $(SCENE),"$(SCENE)")

test: venv  ## format, lint, types, import contracts, unit and property tests
	$(BIN)ruff format --check --quiet .
	$(BIN)ruff check --quiet .
	$(BIN)mypy --strict
	$(BIN)lint-imports --no-logo
	FASTEROIDS_PROFILE=ci $(BIN)python -m pytest -n $(WORKERS) --dist worksteal

test-long: venv  ## the laws at length, a line each at the end (LAW=L3 for one alone)
	FASTEROIDS_PROFILE=long $(BIN)python -m pytest tests/properties -n $(WORKERS) --dist worksteal \
	    --tb=short -rpfEsxX $(ONLY)

test-all:  ## the tests with every Python from 3.11 to 3.13 that is here
	@$(PYTHON) tools/test_all.py -n $(WORKERS)

bench: venv  ## measure, in ratios against a peer and a yardstick
	@$(BIN)python -m benchmarks

fmt: venv  ## format, and repair what the linter can
	$(BIN)ruff format .
	$(BIN)ruff check --fix .

lock: venv  ## write requirements.lock anew (UPGRADE=1 for the newest versions)
	$(BIN)uv pip compile pyproject.toml --no-config --quiet --universal --python-version 3.11 \
	    --fork-strategy fewest --all-extras --generate-hashes --no-emit-index-url \
	    --no-emit-find-links --custom-compile-command "make lock" \
	    $(if $(UPGRADE),--upgrade) --output-file requirements.lock
	@$(PYTHON) tools/environment.py

venv:  ## make or repair .venv; every target above does this by itself
	@$(PYTHON) tools/environment.py

clean:  ## remove every environment, cache and build
	rm -rf .venv .venv-* .hypothesis .import_linter_cache .mypy_cache .pytest_cache .ruff_cache build dist
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
