# A thin front of CMakePresets.json. `make help` lists what there is.
# CMAKE_ARGS is handed to configure: make test CMAKE_ARGS=-DTYNDALL_WERROR=ON
# TYNDALL_INSTALL=no leaves the machine's packages alone.
JOBS ?= $(shell nproc)
CMAKE_ARGS ?=
export TYNDALL_INSTALL

.DEFAULT_GOAL := help
.PHONY: help install configure build test demo bench soak format clean

help: ## This list
	@awk -F ':.*## ' '/^[a-z]+:.*## / {printf "make %-9s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

install: ## Install the Debian packages that are missing (root or sudo)
	@scripts/install.sh

configure: install
	@cmake --preset release $(CMAKE_ARGS)

build: configure ## Build the program: build/tyndall
	@cmake --build --preset release -j $(JOBS) --target tyndall_cli

test: configure ## Build everything and run the tests
	@cmake --build --preset release -j $(JOBS)
	@scripts/run_tests.sh --preset release -j $(JOBS)

demo: build ## Render the demo pictures and say where they are
	@scripts/demo.sh build/tyndall build/demo

bench: install ## Build and run the benchmarks
	@cmake --preset bench $(CMAKE_ARGS)
	@cmake --build --preset bench -j $(JOBS)
	@scripts/bench.sh build-bench

soak: configure ## The long tests (hours), and what they tried (docs/soak.md)
	@cmake --build --preset release -j $(JOBS)
	@scripts/run_tests.sh --preset soak -j $(JOBS) --test-output-size-passed 100000 --output-junit soak.xml; \
	  status=$$?; python3 scripts/soak_page.py build/soak.xml; exit $$status

format: ## Rewrite our sources the way .clang-format says
	@scripts/format.sh --fix

clean: ## Remove what the above built
	rm -rf build build-*
