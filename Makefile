# `make` lists the targets. All that is needed beforehand is Python 3.11 or newer.

# The first of these that is new enough makes the environment; `make run PYTHON=...` names another.
PYTHON ?= python3 python3.14 python3.13 python3.12 python3.11 python
# Arguments for the sandbox: make run ARGS="play newton/atwood"
ARGS ?=
# Which levels `make fuzz` makes.
SEED ?= 0
# How long `make soak` and `make faults` go on: events, steps, processes that are killed.
EVENTS ?= 100000
STEPS ?= 10000000
KILLS ?= 1000
# Processes that share the tests.
WORKERS ?= 2

VENV := .venv
PY := $(VENV)/bin/python
PIP_INSTALL := $(PY) -m pip install -q --disable-pip-version-check --no-input
# No window, no sound; and threads inside of NumPy would only contend with the test processes.
HEADLESS := SDL_VIDEODRIVER=dummy SDL_AUDIODRIVER=dummy OPENBLAS_NUM_THREADS=1
# An environment that is active where this is called is not the one in which anything runs here.
unexport VIRTUAL_ENV

# Each stamp says that the environment holds what its name says, as pyproject.toml asks for it.
FOR_RUN := $(VENV)/.ready-to-run
FOR_TEST := $(VENV)/.ready-to-test
FOR_SITE := $(VENV)/.ready-for-the-site
FOR_FUZZ := $(VENV)/.ready-to-fuzz
# Present while the environment is being changed. Left behind by an interruption, it condemns the lot.
UNFINISHED := $(VENV)/.unfinished

.DEFAULT_GOAL := help
.NOTPARALLEL:
.PHONY: help run test sweep lint check-levels pytest validate quick fuzz bits soak faults lock audit packages report format docs pictures texts site clean

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "make %-13s %s\n", $$1, $$2}' Makefile

run: $(FOR_RUN) ## start the sandbox (set up first, once); ARGS="play newton/atwood" passes arguments
	$(PY) -m sandbox $(ARGS)

test: lint check-levels pytest ## the quick checks (set up first, once); with -k, go on after a failure

lint: $(FOR_TEST) ## style, format, types and the direction of imports
	$(PY) -m ruff check .
	$(PY) -m ruff format --check .
	$(PY) -m mypy
	$(PY) $(VENV)/bin/lint-imports

check-levels: $(FOR_TEST) ## is every level well formed
	$(HEADLESS) $(PY) -m sandbox check levels/*/*.json

pytest: $(FOR_TEST) ## the quick tests
	$(HEADLESS) $(PY) -m pytest -n $(WORKERS) --dist worksteal -m "not sweep"

sweep: validate ## every case, and the long tests, such as all levels over their parameters: some 40 minutes
	$(HEADLESS) $(PY) -m pytest -n $(WORKERS) --dist worksteal -m sweep

validate: $(FOR_TEST) ## every case against its closed form
	$(HEADLESS) $(PY) -m validation run

quick: $(FOR_TEST) ## hard cases and costs in short: do frontiers lie where they did, do levels run
	$(HEADLESS) $(PY) -m validation stability --quick
	$(HEADLESS) $(PY) -m validation cost --quick

fuzz: $(FOR_FUZZ) ## three minutes of levels that nobody would write: is each of them answered
	$(HEADLESS) $(PY) -m validation fuzz --minutes 3 --seed $(SEED)

soak: $(FOR_TEST) ## hours of the window by random events, and of levels: memory and time stay as they are
	$(PY) -m tests.endurance.window --events $(EVENTS) --seed $(SEED)
	$(PY) -m tests.endurance.levels --steps $(STEPS)

faults: $(FOR_TEST) ## every typo, spoilt file and fault of what surrounds a command is answered, killed ones leave whole files
	$(PY) -m tests.endurance.typos --seed $(SEED)
	$(PY) -m tests.endurance.kills --count $(KILLS) --seed $(SEED)
	$(PY) -m tests.endurance.files --seed $(SEED)
	$(PY) -m tests.endurance.faults --seed $(SEED)

lock: $(FOR_TEST) ## write requirements.lock anew: the versions that development is tried with
	.ci/lock $(PY)

audit: $(FOR_TEST) ## known weaknesses and licences of what requirements.lock names
	.ci/audit $(PY)

packages: $(FOR_TEST) ## wheel and sources, installed bare on every Python found, and tried
	.ci/packages $(PY)

report: $(FOR_TEST) ## all of the validation as one page, out/report/report.html: some minutes
	$(HEADLESS) $(PY) -m validation report --output out/report

bits: $(FOR_TEST) ## write states of a few levels anew, which machines of a kind must find to the bit
	$(HEADLESS) $(PY) -m tests.levels.bits

format: $(FOR_TEST) ## put the code into the project's format
	$(PY) -m ruff check --fix .
	$(PY) -m ruff format .

docs: $(FOR_RUN) ## write anew what is generated: JSON Schemas, the reference, the map of the chapter
	$(PY) -m sandbox.model.write_json_schema
	$(PY) -m sandbox.experiments.write_json_schema
	$(PY) -m sandbox.cli.write_reference_pages
	$(PY) -m validation.textbook_coverage

pictures: $(FOR_TEST) ## draw the pictures of the README anew, from the window as it is now
	$(HEADLESS) $(PY) docs/pictures.py

texts: $(FOR_TEST) ## bring the catalogues of the window's languages up to date with what the code says
	$(HEADLESS) $(PY) -m sandbox.cli.update_translations

site: $(FOR_SITE) ## the documents and a gallery of all levels as a site: out/site/index.html
	$(HEADLESS) $(PY) -m mkdocs build --strict

clean: ## remove the environment, caches and builds
	rm -rf $(VENV) build dist *.egg-info
	rm -rf .mypy_cache .ruff_cache .pytest_cache .hypothesis .import_linter_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# $(PY) is a prerequisite so that an environment whose Python has gone is made anew. What serves the
# tests serves the sandbox too, so their set-up leaves both stamps.

$(FOR_RUN): pyproject.toml $(PY)
	@$(open_environment)
	$(PIP_INSTALL) --editable .
	@rm $(UNFINISHED) && touch $(FOR_RUN)

$(FOR_TEST): pyproject.toml $(PY)
	@$(open_environment)
	$(PIP_INSTALL) --editable '.[report,test]'
	@rm $(UNFINISHED) && touch $(FOR_RUN) $(FOR_TEST)

$(FOR_SITE): $(FOR_TEST)
	@touch $(UNFINISHED)
	$(PIP_INSTALL) --editable '.[site]'
	@rm $(UNFINISHED) && touch $(FOR_SITE)

# Led by the code that levels reach, where Atheris has a wheel for this Python; else at random.
$(FOR_FUZZ): $(FOR_TEST)
	@touch $(UNFINISHED)
	$(PIP_INSTALL) --only-binary atheris --editable '.[fuzz]' || echo "Atheris cannot be installed here."
	@rm $(UNFINISHED) && touch $(FOR_FUZZ)

$(PY): ;

# Shell: keep a sound environment or make one, and mark it unfinished: no stamp holds until the end.
define open_environment
set -eu; \
sound='import sys, pip; sys.exit(sys.version_info < (3, 11))'; \
if [ -e $(UNFINISHED) ] || ! $(PY) -c "$$sound" 2>/dev/null; then \
    $(find_python); \
    echo "Setting up $(VENV) with $$python: once, a minute or two."; \
    rm -rf $(VENV); mkdir $(VENV); touch $(UNFINISHED); \
    "$$python" -m venv $(VENV); \
fi; \
touch $(UNFINISHED); rm -f $(FOR_RUN) $(FOR_TEST)
endef

# Shell: set $python, or say what is missing and stop.
define find_python
python=; old=; bare=; \
for candidate in $(PYTHON); do \
    command -v "$$candidate" >/dev/null || continue; \
    if ! "$$candidate" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then \
        old="$$old $$candidate"; \
    elif ! "$$candidate" -c 'import ensurepip, venv' 2>/dev/null; then \
        bare="$$bare $$candidate"; \
    else \
        python=$$candidate; break; \
    fi; \
done; \
if [ -z "$$python" ] && [ -n "$$bare" ]; then \
    echo "error: this Python comes without venv:$$bare" >&2; \
    echo "On Debian and Ubuntu: sudo apt install python3-venv (or python3.12-venv, its number)." >&2; \
    exit 1; \
elif [ -z "$$python" ]; then \
    echo "error: Python 3.11 or newer is needed; tried: $(PYTHON); too old:$${old:- none}" >&2; \
    echo "Install one from python.org, or name it: make $(MAKECMDGOALS) PYTHON=/path/to/python3" >&2; \
    exit 1; \
fi
endef
