# The library.  make help prints these lines, and those of examples/products.mk.
#
# make               draws the pictures of the lessons into out/, then builds the programs
# make test          all tests of shade.h, with a C compiler and make alone; T=clip: one section
# make bench         shade.h beside its rivals, as Markdown; BASE=revision: beside that shade.h
# make bench-plot    charts of the bench
# make install-header  shade.h alone below PREFIX in DESTDIR, for pkg-config and CMake
# make lint          the house rules that a script can hold
# make matrix        the same pictures from other compilers, flags, processors, without a warning
# make conformance   scenes drawn with Mesa's OSMesa as well, pixel by pixel
# make coverage      lines and branches of shade.h that tests and lessons reach
# make mutation      small changes of shade.h, one at a time, that the tests must notice
# make static        clang-tidy and cppcheck
# make prove         no overflow, no access outside an array, over whole ranges of values
# make fuzz          fuzzes calls, sequences of calls and readers for FUZZ_SECONDS
# make vector-report loops over lanes that the compiler left scalar: none
# make dist          the release into dist/: tarballs, wheels, npm package, pages, SBOM, checksums
# make findings      what other software does that one would not guess, and what of it changed

CC      ?= cc
CFLAGS  ?= -O2
WARN     = -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wundef
FLAGS    = -std=c99 $(WARN) $(CFLAGS) -I.
# pictures must not depend on the compiler, so neither do the examples' own sums
EXACT    = -ffp-contract=off
OPENMP   = $(shell echo 'int main(void) { return 0; }' | \
                   $(CC) -fopenmp -x c - -o /dev/null 2>/dev/null && echo -fopenmp)
NUMBERED = $(patsubst examples/lessons/%.c,%,$(sort $(wildcard examples/lessons/[0-9]*.c)))
# those of README, which read well when they are small
POSTER   = 27_exponent 29_grazing 14_two_sided 04_interpolation 07_shaders 24_maps 39_bricks \
           40_fog 22_shadow 21_transparency 37_rays 12_edges
ROOMS    = lessons shared pictures elsewhere elsewhere/test
HEADERS  = shade.h $(wildcard $(ROOMS:%=examples/%/*.h))
vpath %.c $(ROOMS:%=examples/%)

all: pictures
pictures: $(NUMBERED:%=out/%.ppm) out/gallery.ppm out/knot.ppm out/elsewhere.ppm
# programs, packages and courses, which a tarball of the core leaves out
-include examples/products.mk

# each example compiles alone; here they share one build of the implementation
build/shade.o: shade.h
	@mkdir -p build
	@echo '#include "shade.h"' >build/shade.c
	$(CC) $(FLAGS) -DSHADE_IMPLEMENTATION -c build/shade.c -o $@
build/%: %.c build/shade.o $(HEADERS)
	$(CC) $(FLAGS) $(EXACT) -DSHADE__IMPLEMENTED $< build/shade.o $(LDFLAGS) -lm $(LIBRARIES) -o $@
build/19_threads: EXACT += -pthread
build/20_openmp:  EXACT += $(OPENMP)
# what a lesson prints, its captions too, stands beside its picture
$(NUMBERED:%=build/%): EXACT += -DLABEL_SAY
out/%.ppm: build/%
	@mkdir -p out
	build/$* $@ >out/$*.txt
out/gallery.ppm: build/contact $(POSTER:%=out/%.ppm)
	build/contact $@ $(POSTER:%=out/%.ppm)

# other programs' balls beside shade.h's
out/elsewhere.ppm: build/nine $(wildcard examples/elsewhere/tables/*)
	@mkdir -p out
	build/nine $@

# README's program: its first block of C
build/knot.c: README.md
	@mkdir -p build
	sed -n '/^```c$$/,/^```$$/{/^```/d;p;};/^```$$/q' README.md >$@
out/knot.ppm: build/knot.c build/shade.o
	@mkdir -p out
	$(CC) $(FLAGS) $(EXACT) -DSHADE__IMPLEMENTED $< build/shade.o -lm -o build/knot
	cd out && ../build/knot

# -O1 compiles the tests' own code in a third of the time, -O0 in a ninth where little of it runs
UNITS = $(patsubst tests/%.c,build/%.o,$(wildcard tests/unit/*.c))
LEVEL = -O1
QUICK = camera explain matrix modes reads recipes resolve shaders store
$(QUICK:%=build/unit/%.o): LEVEL = -O0
build/unit/%.o: tests/unit/%.c $(wildcard tests/*/*.h) shade.h
	@mkdir -p build/unit
	$(CC) $(FLAGS:-O2=$(LEVEL)) -DSHADE__IMPLEMENTED -c $< -o $@
build/test_main: $(UNITS) build/shade.o
	$(CC) $^ $(LDFLAGS) -lm -o $@
# with an implementation in main.c, which counts what it does
build/test_count: $(filter-out build/unit/main.o,$(UNITS)) tests/unit/main.c
	$(CC) $(FLAGS:-O2=-O0) -DSHADE_NO_DISPATCH -DSHADE__AS_COMPILED $^ -lm -o $@
build/golden: tests/golden/golden.c shade.h
	@mkdir -p build
	$(CC) $(FLAGS) tests/golden/golden.c -o $@

# A section needs three objects of the runner after an edit of shade.h, not all; work counts inside
ifeq ($(T),work)
test: build/test_count
	build/test_count work
else ifneq ($(T),)
SECTION = $(if $(wildcard tests/unit/$(T).c),\
          $(sort $(patsubst %,build/unit/%.o,main scene $(T))),$(UNITS))
test: $(SECTION) build/shade.o
	$(CC) $^ $(LDFLAGS) -lm -o build/test_section
	build/test_section $(T)
else
test:
	@sh tests/scripts/all.sh "$(MAKE)" "$(CC)"
endif

bench:
	@BASE="$(BASE)" sh bench/run.sh
bench-plot:
	@sh bench/plot.sh
matrix:
	@sh tests/scripts/matrix.sh; same=$$?; sh tests/scripts/compilers.sh && exit $$same
conformance:
	@sh tests/scripts/conformance.sh
coverage:
	@sh tests/scripts/coverage.sh
mutation:
	@sh tests/scripts/mutation.sh
static:
	@sh tests/scripts/static.sh
vector-report:
	@sh tests/scripts/vector_report.sh
help:
	@sed -n '/^#/!q; s/^# \{0,1\}//p' Makefile
	@f=examples/products.mk; [ ! -f $$f ] || { echo; sed -n '/^#/!q; s/^# \{0,1\}//p' $$f; }
lint:
	@sh tests/scripts/lint.sh
findings:
	@sh .ci/findings.sh
dist:
	@sh .ci/dist.sh
prove:
	@sh tests/scripts/prove.sh
FUZZ_SECONDS ?= 300
fuzz:
	@sh tests/scripts/fuzz.sh $(FUZZ_SECONDS)

PREFIX  ?= /usr/local
INSTALL ?= install
PLACE    = $(DESTDIR)$(PREFIX)
HEADER   = include/shade.h share/pkgconfig/shade.pc share/cmake/shade/shade-config.cmake \
           share/cmake/shade/shade-config-version.cmake
install-header:
	for f in $(HEADER); do $(INSTALL) -d "$(PLACE)/$${f%/*}" || exit 1; done
	$(INSTALL) -m 644 shade.h "$(PLACE)/include"
	@mkdir -p build
	sh examples/embed/pkgconfig.sh "$(PREFIX)" build
	$(INSTALL) -m 644 build/shade.pc "$(PLACE)/share/pkgconfig"
	$(INSTALL) -m 644 build/shade-config.cmake build/shade-config-version.cmake \
	    "$(PLACE)/share/cmake/shade"

clean:
	rm -rf build out dist
.PHONY: all pictures test bench bench-plot matrix conformance coverage mutation static lint help \
        prove fuzz vector-report findings dist install-header clean
.SECONDARY:
