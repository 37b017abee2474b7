# Everything here needs Python 3.11 or later and make, nothing else: each target sets up .venv itself.
# Another interpreter: make PYTHON=python3.12 ...

# Tests start some hundred processes: what these import is compiled once, also where this variable is set.
unexport PYTHONDONTWRITEBYTECODE

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check
# Twice quiet: only errors are shown. Without byte code: Python writes that of the modules it imports, and most are never.
INSTALL := $(PIP) install --quiet --quiet --no-compile --constraint constraints.txt
DROPS ?= 1000000
# Files of measurements, changed at random: so many, of those of a folder, or of minimal ones.
FILES ?= 5000
FOLDER ?=
SEED ?= 1
ATTACKS ?= signals kills pairs stores disks
PYTEST := $(BIN)/python -m pytest --numprocesses auto --maxprocesses 4 --dist worksteal
# The examples of all functions, and the tests of what leans on libraries. None of libraries' warnings of what comes.
OF_LOWEST := bin/python -m pytest --numprocesses auto --maxprocesses 4 --dist worksteal -m 'not slow' \
  --hypothesis-profile=quick -W ignore::DeprecationWarning -W ignore::PendingDeprecationWarning -W ignore::FutureWarning \
  src/stackbounce $(addprefix tests/,cli fitting measure/reading plots prediction sweeps test_files.py test_shown.py test_units.py) \
  $(addprefix tests/explorer/,test_framing.py test_guard.py test_notebook.py test_server.py)
# 3: kernels cannot be compiled on this machine, plain Python runs. 4: no compiler is in the environment, but pip's build has one.
COMPILE := { PYTHONPATH=src $(BIN)/python -m kernel_build; case $$? in 0|3) ;; 4) $(EDITABLE) ;; *) exit 1 ;; esac; }
EDITABLE := $(INSTALL) --no-deps --editable .
PAGE := { PYTHONPATH=src $(BIN)/python -m page_build || test $$? -eq 3; }
# Three stamps: `make paper` needs the package with all its extras; most other targets the developers' tools, too; `make lowest` an
# environment of its own, which is installed while the kernels are compiled.
RUNTIME := $(VENV)/runtime.stamp
DEV := $(VENV)/dev.stamp
LOWEST := build/lowest/installed.stamp

.DEFAULT_GOAL := help
.PHONY: help venv kernels paper study app explorer test lowest coverage browsers bench check lint types imports docs site format fuzz attack frozen constraints wheels \
	clean distclean

help:  ## list the targets
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/  make \1|\2/p' $(MAKEFILE_LIST) | \
	while IFS='|' read -r target meaning; do printf '%-20s %s\n' "$$target" "$$meaning"; done

paper: kernels  ## recompute the paper: figures, tables and audit, in build/paper
	@$(BIN)/stackbounce paper --out build/paper
	@echo "Open $(CURDIR)/build/paper/index.html"

study: $(DEV) kernels  ## the study of Table II, in build/study, and its tests: half an hour
	@$(BIN)/python -m studies.table2 --out build/study
	@$(PYTEST) studies

app: kernels  ## open the explorer in the browser
	@$(BIN)/stackbounce app

explorer: kernels  ## write the explorer as one HTML file, build/explorer.html
	@mkdir -p build
	@$(BIN)/stackbounce app --export build/explorer.html --overwrite

test: $(DEV) kernels  ## run the fast tests of every kind, in under three minutes on two cores
	@$(PYTEST) -m 'not slow' --hypothesis-profile=quick

lowest: $(LOWEST) kernels  ## examples and fast tests with the lowest versions of all dependencies that pyproject.toml allows
	@PYTHONPATH=$(CURDIR)/src build/lowest/$(OF_LOWEST)

coverage: $(DEV) kernels  ## hold all error bars and comparisons to their claim (make check: some of them); an hour
	@STACKBOUNCE_COVERAGE=all $(PYTEST) tests/*/test_coverage_*.py

browsers: $(DEV) kernels  ## before a release: all tests of the page in Chromium and in Firefox, served and as one file; ten minutes
	@tests/explorer/browser/browsers.sh
	@STACKBOUNCE_BROWSERS="chromium firefox" $(PYTEST) tests/explorer/browser

bench: $(DEV) kernels  ## growth, accuracy, speed, and the benchmark of impacts, also of other solvers (group: bench), in build/bench
	@PYTHONPATH=tests $(BIN)/python -m benchmarks --out build/bench
	@$(BIN)/python -m benchmarks.impacts --out build/bench
	@echo "Open $(CURDIR)/build/bench/index.html"

check: lint types imports docs test  ## everything but what only a release needs: lint, types, import rules, documentation, tests, some in a browser
	@tests/explorer/browser/browsers.sh
	@$(PYTEST) -m '(slow or hypothesis) and not release' tests

fuzz: $(DEV) kernels  ## random drops and files in great number: make fuzz DROPS=1000000 FILES=5000 FOLDER= SEED=1
	@cd tests && PYTHONPATH=.. ../$(BIN)/python -m fuzz --drops $(DROPS) --seed $(SEED)
	@cd tests && PYTHONPATH=.. ../$(BIN)/python -m fuzz.files --count $(FILES) --seed $(SEED) $(abspath $(FOLDER))

attack: $(DEV) kernels  ## all attacks of tests/adversary in great number, a row of a table each: up to an hour; SEED=1
	@cd tests && for name in $(ATTACKS); do ../$(BIN)/python -m adversary.$$name --seed $(SEED) || failed=1; done; \
	  ../$(BIN)/python -m adversary.flood || failed=1; exit $${failed:-0}

frozen: $(DEV) kernels  ## compare the bits of random drops and of all laws with those kept in tests/frozen
	@cd tests && PYTHONPATH=.. ../$(BIN)/python -m frozen

kernels: $(RUNTIME)  ## compile the engine's kernels anew if its sources changed, a minute or two, and make the page anew
	@$(COMPILE)
	@$(PAGE)

lint: $(DEV)  ## ruff's rules and formatting
	@$(BIN)/ruff check
	@$(BIN)/ruff format --check

types: $(DEV)  ## mypy --strict on the package
	@$(BIN)/mypy

imports: $(DEV)  ## the import rules (import-linter)
	@$(BIN)/lint-imports

docs: $(DEV) kernels  ## build the documentation in build/docs, warnings being errors
	@$(BIN)/python -m sphinx -q -E -W --keep-going -n -b html -d build/doctrees docs build/docs
	@echo "Documentation: $(CURDIR)/build/docs/index.html"

site: $(DEV) kernels  ## the documentation and the explorer as a folder for a server or a stick, build/site; each page is visited in Chromium
	@rm -rf build/site
	@$(BIN)/python -m sphinx -q -E -W --keep-going -n -b html -d build/doctrees docs build/site
	@$(BIN)/python site_check.py build/site

format: $(DEV)  ## let ruff put the code in order
	@$(BIN)/ruff check --fix
	@$(BIN)/ruff format

constraints:  ## write constraints.txt anew from the newest versions that fit
	@rm -rf build/constraints
	@$(PYTHON) -m venv build/constraints
	@for kind in runtime dev; do $(PYTHON) .ci/requirements.py $$kind; done > build/constraints/requirements.txt
	@build/constraints/bin/python -m pip --disable-pip-version-check install --quiet --quiet --requirement build/constraints/requirements.txt
	@{ sed -n '/^#/p' constraints.txt; \
	   build/constraints/bin/python -m pip --disable-pip-version-check freeze --all \
	     --exclude pip --exclude setuptools | grep -E '^[A-Za-z0-9._-]+==[^ @]+$$'; } > build/constraints.txt
	@mv build/constraints.txt constraints.txt
	@rm -rf build/constraints

wheels: $(DEV)  ## build the wheels of all platforms and the sdist in dist, and check them; on Linux
	@PYTHONPATH=src $(BIN)/python wheel_build.py

clean:  ## remove what was built, keep .venv
	@rm -rf build dist .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
	@find src tests docs benchmarks -name __pycache__ -type d -prune -exec rm -rf {} +

distclean: clean  ## remove .venv too
	@rm -rf $(VENV)

venv: $(DEV)  ## set up .venv with the developers' tools

$(LOWEST): pyproject.toml constraints.txt .ci/requirements.py
	@rm -rf build/lowest
	@$(PYTHON) -m venv build/lowest
	@$(PYTHON) .ci/requirements.py lowest > build/lowest/requirements.txt
	@build/lowest/bin/python -m pip --disable-pip-version-check install --quiet --quiet --no-compile \
	  --requirement build/lowest/requirements.txt
	@touch $@

$(DEV): $(RUNTIME)
	@echo "Installing the developers' tools into $(VENV)"
	@$(BIN)/python .ci/requirements.py dev > $(VENV)/dev.txt
	@$(INSTALL) --requirement $(VENV)/dev.txt
	@touch $@

$(RUNTIME): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || \
	  { echo "stackbounce needs Python 3.11 or later, which '$(PYTHON)' is not: try make PYTHON=python3.12" >&2; exit 1; }
	@test -x $(BIN)/pip || $(PYTHON) -m venv --clear $(VENV) || \
	  { echo "Python's venv module does not work here (on Debian or Ubuntu: apt install python3-venv)" >&2; exit 1; }
	@echo "Installing stackbounce into $(VENV), and compiling its kernels: a few minutes"
	@$(BIN)/python .ci/requirements.py runtime > $(VENV)/runtime.txt
	@$(INSTALL) --requirement $(VENV)/runtime.txt & installing=$$!; $(EDITABLE); compiled=$$?; \
	  wait $$installing && exit $$compiled # pip has one processor, the compiler the others
	@touch $@
