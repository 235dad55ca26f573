# make               builds the examples and draws the gallery into out/
# make test          all tests, with a C compiler and make alone; T=clip runs one section
# make lint          the house rules that a script can hold
# make format        lays C files out by .clang-format (clang-format 14); FORMAT=files
# make bench         shade.h beside its rivals, as Markdown; BASE=revision: beside that shade.h
# make bench-plot    charts of the bench
# make matrix        the same pictures from other compilers, flags, processors, without a warning
# make conformance   scenes drawn with Mesa's OSMesa as well, pixel by pixel
# make coverage      lines and branches of shade.h that tests and examples reach
# make mutation      small changes of shade.h, one at a time, that the tests must notice
# make static        clang-tidy and cppcheck
# make prove         no overflow, no access outside an array, over whole ranges of values
# make fuzz          fuzzes calls, sequences of calls and readers for FUZZ_SECONDS
# make gallery       the PNGs of the README
# make playground    the equation and four courses as web pages, build/playground/index.html
# make course        pages and slides of the courses alone, and their slides with answers as PDF
# make course-zip    the courses in build/playground/courses.zip; PLAYGROUND=an index.html, built
# make assignments   tries the grader of the assignments: solutions, wrong answers, what holds programs
# make dist          the release into dist/: tarball, wheels, npm package, pages, SBOM, checksums
# make install       header, programs, man pages, completions for bash, thumbnailer and types
#                    below PREFIX in DESTDIR; make uninstall removes them;
#                    make install-header: the header alone, for pkg-config and CMake
# make findings      what other software does that one would not guess, and what of it changed
# make vector-report loops over lanes that the compiler left scalar: none

CC      ?= cc
CFLAGS  ?= -O2
WARN     = -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wundef
FLAGS    = -std=c99 $(WARN) $(CFLAGS) -I.
# pictures must not depend on the compiler, so neither do the examples' own sums
EXACT    = -ffp-contract=off
OPENMP   = $(shell echo 'int main(void) { return 0; }' | \
                   $(CC) -fopenmp -x c - -o /dev/null 2>/dev/null && echo -fopenmp)
# view and batch need POSIX; the window of view SDL2 (libsdl2-dev), its sixels libsixel
# (libsixel-dev)
POSIX    = $(shell echo | $(CC) -fsyntax-only -include termios.h -x c - 2>/dev/null && \
                   echo build/view build/batch build/sheets || \
                   echo 'no termios.h: view, batch and sheets are left out' >&2)
SDL2     = $(shell flags="$$(sdl2-config --cflags --libs 2>/dev/null | sed 's/-I/-isystem /g')"; \
                   echo 'int main(int n, char **v) { return v && SDL_Init(0) > n; }' | \
                   $(CC) -include SDL.h -x c - $$flags -o $@.sdl2 2>/dev/null && rm -f $@.sdl2 && \
                   echo -DVIEW_SDL $$flags || echo 'no SDL2: the window of view is left out' >&2)
SIXEL    = $(shell echo 'int main(void) { return !sixel_output_new; }' | \
                   $(CC) -include sixel/sixel.h -x c - -o $@.sixel -lsixel 2>/dev/null && \
                   rm -f $@.sixel && echo -DVIEW_SIXEL -lsixel || \
                   echo 'no libsixel: sixels of view are left out' >&2)

# pictures on surfaces and PNG are stb's (libstb-dev), formats beyond OBJ, STL, PLY, OFF,
# glTF and 3MF assimp's (libassimp-dev)
# files in archives are unpacked by zlib (zlib1g-dev)
ZLIB     = $(shell flags="$$(pkg-config --cflags --libs zlib 2>/dev/null || echo -lz)"; \
                   echo "int main(void) { return !zlibVersion(); }" | \
                   $(CC) -include zlib.h -x c - $$flags -o $@.zlib 2>/dev/null && \
                   rm -f $@.zlib && echo -DMODEL_ZLIB $$flags || \
                   echo "no zlib: 3MF that is packed is left out" >&2)
STB      = $(shell echo | $(CC) -fsyntax-only -include stb/stb_image.h -include \
                   stb/stb_image_write.h -x c - 2>/dev/null && \
                   echo -DMODEL_STB || \
                   echo 'no stb: PNG and textures are left out' >&2)
ASSIMP   = $(shell echo 'int main(void) { aiDetachAllLogStreams(); return 0; }' | \
                   $(CC) -include assimp/cimport.h -x c - -lassimp -o $@.assimp 2>/dev/null && \
                   rm -f $@.assimp && echo -DMODEL_ASSIMP -lassimp || \
                   echo 'no assimp: programs read OBJ, STL, PLY, OFF, glTF and 3MF alone' >&2)

NUMBERED = $(patsubst examples/lessons/%.c,%,$(sort $(wildcard examples/lessons/[0-9]*.c)))
# those of README, which read well when they are small
POSTER   = 27_exponent 29_grazing 14_two_sided 04_interpolation 07_shaders 24_maps 39_bricks \
           40_fog 22_shadow 21_transparency 37_rays 12_edges
ROOMS    = lessons shared pictures elsewhere elsewhere/test \
           $(addprefix kit/,read scene draw image command) $(addprefix programs/,thumbnail view batch compare)
HEADERS  = shade.h $(wildcard $(ROOMS:%=examples/%/*.h))
vpath %.c $(ROOMS:%=examples/%)

all: pictures programs
pictures: $(NUMBERED:%=out/%.ppm) out/gallery.ppm out/knot.ppm out/elsewhere.ppm
PROGRAMS = build/thumbnail build/compare $(POSIX)
programs: $(PROGRAMS)

# each example compiles alone; here they share one build of the implementation
build/shade.o: shade.h
	@mkdir -p build
	$(CC) $(FLAGS) -DSHADE_IMPLEMENTATION -x c -c shade.h -o $@
build/%: %.c build/shade.o $(HEADERS)
	$(CC) $(FLAGS) $(EXACT) -DSHADE__IMPLEMENTED $< build/shade.o $(LDFLAGS) -lm $(LIBRARIES) -o $@
build/19_threads $(PROGRAMS): EXACT += -pthread
build/20_openmp:  EXACT += $(OPENMP)
build/view: LIBRARIES = $(SDL2) $(SIXEL) $(STB) $(ZLIB) $(ASSIMP)
build/thumbnail build/batch build/compare: LIBRARIES = $(STB) $(ZLIB) $(ASSIMP)
build/sheets.1 build/sheets.bash: build/thumbnail
build/sheets: examples/programs/batch/sheets.sh
	@mkdir -p build
	cp $< $@ && chmod +x $@
out/%.ppm: build/%
	@mkdir -p out
	build/$* $@
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

# -O1 compiles the tests' own code in a third of the time
UNITS = $(patsubst tests/%.c,build/%.o,$(wildcard tests/unit/*.c))
build/unit/%.o: tests/unit/%.c $(wildcard tests/*/*.h) shade.h
	@mkdir -p build/unit
	$(CC) $(FLAGS:-O2=-O1) -DSHADE__IMPLEMENTED -c $< -o $@
build/test_main: $(UNITS) build/shade.o
	$(CC) $^ $(LDFLAGS) -lm -o $@
# with an implementation in main.c, which counts what it does
build/test_count: $(filter-out build/unit/main.o,$(UNITS)) tests/unit/main.c
	$(CC) $(FLAGS:-O2=-O0) -DSHADE_NO_DISPATCH -DSHADE__AS_COMPILED $^ -lm -o $@
build/golden: tests/golden/golden.c shade.h
	@mkdir -p build
	$(CC) $(FLAGS) tests/golden/golden.c -o $@

ifdef T
test: build/test_main
	build/test_main $(T)
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
gallery: all
	@sh examples/pictures/gallery.sh
playground:
	@sh examples/teaching/playground/build.sh; made=$$?; \
	sh examples/teaching/course/build.sh && exit $$made
course:
	@PDF=1 sh examples/teaching/course/build.sh
course-zip:
	@PACK=1 PLAYGROUND="$(PLAYGROUND)" sh examples/teaching/course/build.sh
assignments:
	@sh examples/teaching/assignments/test/assignments.sh
coverage:
	@sh tests/scripts/coverage.sh
mutation:
	@sh tests/scripts/mutation.sh
static:
	@sh tests/scripts/static.sh
vector-report:
	@sh tests/scripts/vector_report.sh
lint:
	@sh tests/scripts/lint.sh
FORMAT ?= $(wildcard $(addprefix examples/,kit/*.c kit/*/*.h programs/*/*.[ch]))
format:
	clang-format -i --style=file $(FORMAT)
format-check:
	@clang-format -n -Werror --style=file $(FORMAT)
findings:
	@sh .ci/findings.sh
dist:
	@sh .ci/dist.sh
prove:
	@sh tests/scripts/prove.sh
FUZZ_SECONDS ?= 300
fuzz:
	@sh tests/scripts/fuzz.sh $(FUZZ_SECONDS)

# Installed programs begin with shade-, for "view" is anybody's.
BESIDE   = examples/programs/install
PREFIX  ?= /usr/local
INSTALL ?= install
SAYS_thumbnail = draws a picture of a model file
SAYS_view      = shows a model turning, in a terminal or a window
SAYS_batch     = renders films and posters of a model, in pieces that machines can share
SAYS_sheets    = draws a sheet of views of every model in a folder
SAYS_compare   = tells by how much two pictures differ
PLACE     = $(DESTDIR)$(PREFIX)
HEADER    = include/shade.h share/pkgconfig/shade.pc share/cmake/shade/shade-config.cmake \
            share/cmake/shade/shade-config-version.cmake
# GNOME runs thumbnailers where they see /usr alone, and remembers each file that failed: there is no
# entry for a program that lies elsewhere
THUMBNAILER = $(if $(filter /usr /usr/%,$(PREFIX)),share/thumbnailers/shade.thumbnailer)
FILES     = $(HEADER) share/mime/packages/shade.xml share/applications/shade-view.desktop $(THUMBNAILER)
INSTALLED = $(FILES) $(foreach p,thumbnail view batch sheets compare,bin/shade-$p \
            share/man/man1/shade-$p.1 share/bash-completion/completions/shade-$p)
build/%.bash: build/% $(BESIDE)/completion.sh
	THUMBNAIL=build/thumbnail sh $(BESIDE)/completion.sh build/$* shade-$* >$@
build/%.1: build/% $(BESIDE)/man.sh
	THUMBNAIL=build/thumbnail sh $(BESIDE)/man.sh build/$* shade-$* '$(SAYS_$*)' >$@
install-header:
	for f in $(HEADER); do $(INSTALL) -d "$(PLACE)/$${f%/*}" || exit 1; done
	$(INSTALL) -m 644 shade.h "$(PLACE)/include"
	@mkdir -p build
	sh $(BESIDE)/pkgconfig.sh "$(PREFIX)" build
	$(INSTALL) -m 644 build/shade.pc "$(PLACE)/share/pkgconfig"
	$(INSTALL) -m 644 build/shade-config.cmake build/shade-config-version.cmake \
	    "$(PLACE)/share/cmake/shade"
install: programs install-header
	sh $(BESIDE)/desktop.sh "$(PREFIX)" thumbnailer >build/shade.thumbnailer
	sh $(BESIDE)/desktop.sh "$(PREFIX)" view >build/shade-view.desktop
	for f in $(INSTALLED); do $(INSTALL) -d "$(PLACE)/$${f%/*}" || exit 1; done
	for p in $(notdir $(PROGRAMS)); do \
	    $(MAKE) -s build/$$p.1 build/$$p.bash && \
	    $(INSTALL) -m 755 build/$$p "$(PLACE)/bin/shade-$$p" && \
	    $(INSTALL) -m 644 build/$$p.1 "$(PLACE)/share/man/man1/shade-$$p.1" && \
	    $(INSTALL) -m 644 build/$$p.bash "$(PLACE)/share/bash-completion/completions/shade-$$p" || \
	    exit 1; done
	$(if $(THUMBNAILER),$(INSTALL) -m 644 build/shade.thumbnailer "$(PLACE)/share/thumbnailers")
	$(INSTALL) -m 644 build/shade-view.desktop "$(PLACE)/share/applications"
	$(INSTALL) -m 644 $(BESIDE)/mime.xml "$(PLACE)/share/mime/packages/shade.xml"
	@echo "$(if $(THUMBNAILER),for thumbnails in file managers: update-mime-database \
	$(PREFIX)/share/mime,no thumbnails in file managers: GNOME shows thumbnailers /usr alone; \
	install with PREFIX=/usr or /usr/local)"
uninstall:
	for f in $(INSTALLED); do rm -f "$(PLACE)/$$f" || exit 1; done

clean:
	rm -rf build out dist
.PHONY: all pictures programs test assignments course course-zip bench bench-plot matrix \
        conformance coverage mutation static lint format format-check prove fuzz gallery \
        playground vector-report findings dist install install-header uninstall clean
.SECONDARY:
