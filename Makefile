# A thin front of CMakePresets.json. `make help` lists what there is.
# CMAKE_ARGS is handed to configure: make test CMAKE_ARGS=-DTYNDALL_WERROR=ON
# TYNDALL_INSTALL=no leaves the machine's packages alone.
JOBS ?= $(shell nproc)
CMAKE_ARGS ?=
export TYNDALL_INSTALL

.DEFAULT_GOAL := help
.PHONY: help install build test demo bench soak format clean

help: ## This list
	@awk -F ':.*## ' '/^[a-z]+:.*## / {printf "make %-9s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

install: ## Install the Debian packages that are missing (root or sudo), for all of the below
	@scripts/install.sh

# The program alone: a first configure leaves the tests off, which need packages of their own; a later one keeps them.
first = $(if $(wildcard build/CMakeCache.txt),,-DTYNDALL_BUILD_TESTS=OFF)
program = cmake --preset release $(first) $(CMAKE_ARGS) && cmake --build --preset release -j $(JOBS) --target tyndall_cli
with_tests = scripts/install.sh demo build test && cmake --preset release -DTYNDALL_BUILD_TESTS=ON $(CMAKE_ARGS) && \
  cmake --build --preset release -j $(JOBS)

build: ## Build the program: build/tyndall
	@scripts/install.sh demo build
	@$(program)

test: ## Build everything and run the tests
	@$(with_tests)
	@scripts/run_tests.sh --preset release -j $(JOBS)

demo: ## Render the demo pictures and say where they are
	@scripts/install.sh demo
	@$(program)
	@scripts/demo.sh build/tyndall build/demo

bench: ## Build and run the benchmarks
	@scripts/install.sh demo build bench
	@cmake --preset bench $(CMAKE_ARGS)
	@cmake --build --preset bench -j $(JOBS)
	@scripts/bench.sh build-bench

soak: ## The long tests (hours), and what they tried (docs/soak.md)
	@$(with_tests)
	@scripts/run_tests.sh --preset soak -j $(JOBS) --test-output-size-passed 100000 --output-junit soak.xml; \
	  status=$$?; python3 scripts/soak_page.py build/soak.xml; exit $$status

format: ## Rewrite our sources the way .clang-format says
	@scripts/format.sh --fix

clean: ## Remove what the above built
	rm -rf build build-*
