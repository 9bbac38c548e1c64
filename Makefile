# Everything a newcomer, a developer and the build machine do. `make` alone lists it.

VENV := .venv
BIN := $(VENV)/bin
PYTEST := $(BIN)/python -m pytest
# Three for two cores: browser tests wait a lot.
PARALLEL := -n 3 --dist loadfile --max-worker-restart 1

# The first interpreter that is new enough and can make environments.
PYTHON = $(shell for name in python3 python3.14 python3.13 python3.12 python3.11; do \
	$$name -c 'import sys, ensurepip, venv; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$name && break; done)

# Without bytecode, every process rewrites all tests and compiles all modules anew.
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := help
.PHONY: help edit test fast lint check nightly versions bench gen pictures reference vscode clean chromium gpp neovim

help:  ## list these commands
	@awk -F ':.*## ' '/^[a-z]+:.*## / {printf "make %-9s  %s\n", $$1, $$2}' Makefile

edit: $(VENV)/.ready  ## open the editor on designs/
	@$(BIN)/vicode edit designs

test: $(VENV)/.ready-test chromium gpp neovim  ## pass every test, a real browser included (18 minutes on two cores)
	@$(PYTEST) $(PARALLEL)

fast: $(VENV)/.ready-test gpp neovim  ## pass the tests that need no browser
	@$(PYTEST) $(PARALLEL) -m "not browser and not nightly"

lint: $(VENV)/.ready-dev  ## format, lint, types, import contracts
	$(BIN)/ruff format --check
	$(BIN)/ruff check
	$(BIN)/mypy
	$(BIN)/mypy --platform win32 --cache-dir .mypy_cache/win32 vicode
	$(BIN)/mypy --platform darwin --cache-dir .mypy_cache/darwin vicode
	$(BIN)/lint-imports

check: lint gpp neovim  ## lint, and the fast tests (about six minutes)
	@$(PYTEST) $(PARALLEL) -m "not browser and not nightly"

nightly: $(VENV)/.ready-test chromium gpp neovim versions  ## the long runs: fuzzing, other Pythons and versions, the browser tests 20 times
	@VICODE_HYPOTHESIS=nightly $(PYTEST) $(PARALLEL) --timeout 3600 -m "nightly or hypothesis"
	@failed=0; for run in $$(seq 20); do echo "Browser tests, run $$run of 20:"; \
		VICODE_ONE_TRY=1 $(PYTEST) $(PARALLEL) -m "browser and not nightly" || failed=1; done; \
		echo "Browser tests, up to 120 ms for each message:"; \
		VICODE_LINE_MS=120 VICODE_ONE_TRY=1 $(PYTEST) $(PARALLEL) -m "browser and not nightly" || failed=1; exit $$failed

versions: $(VENV)/.ready-nightly  ## pass the fast tests with the lowest allowed versions and on each Python
	@.ci/versions

bench: $(VENV)/.ready-bench  ## measure against a hand-written machine and other libraries
	@$(BIN)/python -m benchmarks

gen: $(VENV)/.ready  ## write generated/ anew from designs/
	@$(BIN)/vicode gen designs

pictures: $(VENV)/.ready-test chromium  ## take the pictures of docs/pictures again
	@$(BIN)/python -m tests.manual.take_pictures
	@$(BIN)/python -m tests.experiments.take_pictures

reference: $(VENV)/.ready-test  ## regenerate docs/reference and the tables of docs/design-format.md from the code
	@$(PYTEST) -q tests/manual/test_reference.py tests/store/test_format_page.py --accept

# In build/, because vsce packages what npm installs beside package.json. The grammar and the version come from vicode.
vscode: $(VENV)/.ready  ## package the extension for VS Code as dist/vicode.vsix (needs npm)
	rm -rf build/vscode
	mkdir -p build dist
	cp -r vicode/vscode build/vscode
	cp LICENSE build/vscode
	$(BIN)/vicode xabsl lsp --grammar > build/vscode/xabsl.tmLanguage.json
	cd build/vscode && npm version --no-git-tag-version "$$(../../$(BIN)/vicode --version | cut -d ' ' -f 2)" && npm install --omit=dev
	cd build/vscode && npx --yes @vscode/vsce package --allow-missing-repository --out ../../dist/vicode.vsix

clean:  ## remove the environment and all caches
	rm -rf $(VENV) build dist .hypothesis .import_linter_cache .mypy_cache .nicegui .pytest_cache .ruff_cache test-results
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

chromium: $(VENV)/.ready-test
	@.ci/chromium

gpp:
	@.ci/gpp

neovim:
	@.ci/neovim

$(BIN)/python:
	@test -n "$(PYTHON)" || { echo "vicode needs Python 3.11 or newer with venv: sudo apt install python3-venv" >&2; exit 1; }
	@$(PYTHON) -m venv $(VENV)

$(VENV)/.ready: pyproject.toml | $(BIN)/python
	@echo "Installing vicode into $(VENV) (once, about a minute)."
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable .
	@touch $@

$(VENV)/.ready-%: pyproject.toml | $(BIN)/python
	@echo "Installing vicode with its extra $* into $(VENV) (once, about a minute)."
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[$*]'
	@touch $@
