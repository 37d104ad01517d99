# make demo: install, build a release, fold the helmet rib.   make test: build and run all tests.
# make bench: measure the figures of benchmarks/README.md.    make asan, make tsan: tests under a sanitizer.
JOBS ?= $(shell nproc)
SUDO := $(shell [ "$$(id -u)" = 0 ] || echo sudo)

.PHONY: demo test bench asan tsan release dev packages install clean

demo: release
	build/release/bin/kinetix-opt targets/shapes/helmet_rib.yaml -o results/helmet_rib

test: dev
	ctest --preset dev

bench: release
	build/release/bin/kinetix-bench --write benchmarks/README.md; figures=$$?; \
	build/release/bin/kinetix-hard-cases --write benchmarks/README.md && exit $$figures

asan tsan: packages
	cmake --preset $@
	cmake --build --preset $@ -j $(JOBS)
	ctest --preset $@

release dev: packages
	cmake --preset $@
	cmake --build --preset $@ -j $(JOBS)

packages: build/.packages

build/.packages: packages.txt
	@mkdir -p build
	@missing=$$(grep -v '^#' packages.txt | xargs -n 1 sh -c 'dpkg -s "$$0" >/dev/null 2>&1 || echo "$$0"'); \
	if [ -n "$$missing" ]; then \
	  $(SUDO) apt-get update -qq && \
	  $(SUDO) env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing; \
	fi
	@touch $@

install: release
	cmake --install build/release

clean:
	rm -rf build results
