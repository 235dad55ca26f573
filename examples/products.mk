# The products: programs, packages and courses, above the library.
#
# make products      builds the programs, and tests all products by room; T=thumbnail: that room
# make programs      builds the programs: thumbnail, view, batch, sheets, compare
# make install       header, programs, man pages, completions for bash, thumbnailer and types
#                    below PREFIX in DESTDIR; make uninstall removes them
# make gallery       the PNGs of the README
# make playground    the equation and four courses as web pages, build/playground/index.html
# make course        pages and slides of the courses alone, and their slides with answers as PDF
# make course-zip    the courses in build/playground/courses.zip; PLAYGROUND=an index.html, built
# make assignments   tries the grader: solutions, wrong answers, what holds programs
# make project       tries the project's judge: solutions, starters, mistakes, what students get
# make questions     tries the bank of questions and exams: answers, Moodle, QTI, sheets
# make format        lays out kit and programs by .clang-format (clang-format 14); FORMAT=files

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

PROGRAMS = build/thumbnail build/compare $(POSIX)
PARTS    = $(addprefix kit/,read scene draw image command) \
           $(addprefix programs/,thumbnail view batch compare)
vpath %.c $(PARTS:%=examples/%)
all: programs
programs: $(PROGRAMS)
products: programs
	@sh examples/products.sh $(T)
$(PROGRAMS): $(wildcard $(PARTS:%=examples/%/*.h))
$(PROGRAMS): EXACT += -pthread
build/view: LIBRARIES = $(SDL2) $(SIXEL) $(STB) $(ZLIB) $(ASSIMP)
build/thumbnail build/batch build/compare: LIBRARIES = $(STB) $(ZLIB) $(ASSIMP)
build/sheets.1 build/sheets.bash: build/thumbnail
build/sheets: examples/programs/batch/sheets.sh
	@mkdir -p build
	cp $< $@ && chmod +x $@

playground:
	@sh examples/teaching/playground/build.sh; made=$$?; \
	sh examples/teaching/course/build.sh && exit $$made
course:
	@PDF=1 sh examples/teaching/course/build.sh
course-zip:
	@PACK=1 PLAYGROUND="$(PLAYGROUND)" sh examples/teaching/course/build.sh
assignments:
	@sh examples/teaching/assignments/test/assignments.sh
project:
	@sh examples/teaching/project/test/project.sh
questions:
	@sh examples/teaching/questions/test/questions.sh
gallery: all
	@sh examples/pictures/gallery.sh
FORMAT ?= $(wildcard $(addprefix examples/,kit/*.c kit/*/*.h programs/*/*.[ch]))
format:
	clang-format -i --style=file $(FORMAT)
format-check:
	@clang-format -n -Werror --style=file $(FORMAT)

# Installed programs begin with shade-, for "view" is anybody's.
BESIDE   = examples/programs/install
SAYS_thumbnail = draws a picture of a model file
SAYS_view      = shows a model turning, in a terminal or a window
SAYS_batch     = renders films and posters of a model, in pieces that machines can share
SAYS_sheets    = draws a sheet of views of every model in a folder
SAYS_compare   = tells by how much two pictures differ
# GNOME runs thumbnailers where they see /usr alone, and remembers each file that failed: there is
# no entry for a program that lies elsewhere
THUMBNAILER = $(if $(filter /usr /usr/%,$(PREFIX)),share/thumbnailers/shade.thumbnailer)
FILES     = $(HEADER) share/mime/packages/shade.xml share/applications/shade-view.desktop \
            $(THUMBNAILER)
INSTALLED = $(FILES) $(foreach p,thumbnail view batch sheets compare,bin/shade-$p \
            share/man/man1/shade-$p.1 share/bash-completion/completions/shade-$p)
# folders that uninstall takes away where they are empty; of the system's own, what is below share
FOLDERS   = share/cmake/shade share/cmake share/pkgconfig share/thumbnailers share/applications \
            share/mime/packages share/mime share/bash-completion/completions share/bash-completion \
            share/man/man1 share/man $(if $(filter /usr /usr/local,$(PLACE)),,share bin include)
build/%.bash: build/% $(BESIDE)/completion.sh
	THUMBNAIL=build/thumbnail sh $(BESIDE)/completion.sh build/$* shade-$* >$@
build/%.1: build/% $(BESIDE)/man.sh
	THUMBNAIL=build/thumbnail sh $(BESIDE)/man.sh build/$* shade-$* '$(SAYS_$*)' >$@
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
	@! cd "$(PLACE)" 2>/dev/null || rmdir $(FOLDERS) 2>/dev/null; rmdir "$(PLACE)" 2>/dev/null; true

.PHONY: products programs install uninstall gallery playground course course-zip assignments \
        project questions format format-check
