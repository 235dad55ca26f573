# desktops.sh - part of install.sh: the thumbnail services of desktops draw the models that install.sh has
# made: Xfce's tumbler by D-Bus, and GNOME's factory in its sandbox, where the program must lie below /usr.

D=$T/services
mkdir -p "$D/data/thumbnailers" "$D/data/mime/packages" "$D/cache" "$D/gnome"
cp "$T/shade.thumbnailer" "$D/data/thumbnailers"
[ ! -f /usr/share/mime/packages/freedesktop.org.xml ] ||
    cp /usr/share/mime/packages/freedesktop.org.xml "$P/share/mime/packages/shade.xml" "$D/data/mime/packages"
of_services() { env HOME="$D" XDG_CACHE_HOME="$D/cache" XDG_DATA_DIRS="$D/data:/usr/share" "$@"; }
served() {                      # folder: a picture of more than one colour for each file
    for file in "$T/models/"*.*; do
        [ "${file##*.}" != png ] && [ "${file##*/}" != signed.obj ] || continue
        name=$(python3 -c 'import hashlib, pathlib, sys
print(hashlib.md5(pathlib.Path(sys.argv[1]).as_uri().encode()).hexdigest())' "$file")
        check "$2 has a thumbnail of ${file##*.}" test -s "$1/$name.png"
    done
}

tumbler=$(find /usr/lib /usr/libexec -name tumblerd 2>/dev/null | head -n 1)
if [ "$tumbler" ] && there dbus-run-session && there gdbus && there update-mime-database && there python3; then
    of_services update-mime-database "$D/data/mime"
    cat >"$D/ask" <<'END'
bus=org.freedesktop.thumbnails.Thumbnailer1
"$1" >/dev/null 2>&1 & service=$!
shift
for k in 1 2 3 4 5 6 7 8 9 10; do
    gdbus wait --session --timeout 3 $bus && break
done
ask() { gdbus call --session --dest $bus --object-path "/$(echo $bus | tr . /)" --method "$bus.Queue" "$@"; }
uris= types=
for pair; do
    uris="$uris${uris:+, }\"${pair%|*}\"" types="$types${types:+, }\"${pair#*|}\""
done
ask "[$uris]" "[$types]" normal foreground 0
last=-1 same=0
while [ $same -lt 10 ]; do      # until nothing has come for ten seconds
    sleep 1
    now=$(find "$XDG_CACHE_HOME/thumbnails" -name '*.png' 2>/dev/null | wc -l)
    [ "$now" -eq "$last" ] && same=$((same + 1)) || same=0
    [ "$now" -lt "$#" ] || same=10
    last=$now
done
kill $service
END
    set --
    for file in "$T/models/"*.*; do
        [ "${file##*.}" != png ] && [ "${file##*/}" != signed.obj ] || continue
        uri=$(python3 -c 'import pathlib, sys; print(pathlib.Path(sys.argv[1]).as_uri())' "$file")
        set -- "$@" "$uri|$(of_services gio info -a standard::content-type "$file" | sed -n 's/.*content-type: //p')"
    done
    of_services timeout 300 dbus-run-session -- sh "$D/ask" "$tumbler" "$@" >"$D/said" 2>&1
    served "$D/cache/thumbnails/normal" tumbler
else left_out "thumbnails by tumbler: no tumbler, D-Bus, GLib's tools or python3"
fi

# the program below /usr/local in a namespace of its own, so that nothing is installed here
cat >"$D/factory.py" <<'END'
import pathlib, sys
import gi
gi.require_version('GnomeDesktop', '3.0')
from gi.repository import GnomeDesktop
factory = GnomeDesktop.DesktopThumbnailFactory.new(GnomeDesktop.DesktopThumbnailSize.NORMAL)
for pair in sys.argv[1:]:
    uri, kind = pair.split('|')
    assert factory.can_thumbnail(uri, kind, 0), kind
    drawn = factory.generate_thumbnail(uri, kind)
    print(kind, drawn and (drawn.get_width(), drawn.get_height()))
END
local='mount --bind "$1" /usr/local && shift && exec "$@"'
if there bwrap && bwrap --ro-bind / / --unshare-all true 2>/dev/null && [ $# -gt 0 ] &&
    unshare -m true 2>/dev/null && /usr/bin/python3 -c "import gi
gi.require_version('GnomeDesktop', '3.0')" 2>/dev/null; then
    mkdir -p "$D/local/bin"
    cp "$P/bin/shade-thumbnail" "$D/local/bin"
    sh examples/programs/install/desktop.sh /usr/local thumbnailer >"$D/data/thumbnailers/shade.thumbnailer"
    of_services timeout 300 unshare -m sh -c "$local" sh "$D/local" \
        dbus-run-session -- /usr/bin/python3 "$D/factory.py" "$@" >"$D/drawn" 2>"$D/said"
    for pair; do
        kind=${pair#*|}
        check "GNOME's factory draws $kind" grep -qx "$kind (128, 128)" "$D/drawn"
    done
else left_out "thumbnails by GNOME: no libgnome-desktop, python3-gi or bubblewrap that may be used"
fi
