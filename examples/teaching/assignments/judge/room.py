"""The room in which a student's file is compiled and run.

With bubblewrap (https://github.com/containers/bubblewrap) the room is a tree of its own: the program
and nothing else for C, the system's programs beside it for the compiler and for Python; no network, no
process but its own.  Without it the room is a folder of the machine, and what bounds it is the user:
where the judge is root, as in a container of Gradescope, compiler and program belong to nobody.

In both, memory, time and sizes of files are bounded before the compiler or the program starts;
hold.c bounds open files and processes before the first instruction of a C program.
"""
import os
import pwd
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
MEGABYTES = 256  # of memory, for a program
PRINTED = 1 << 16  # bytes that a program may print
BUILD = 2048, 30, 16 << 20  # megabytes, seconds and bytes of a file, for a compiler
BUILD_PROCESSES = 128  # of nobody, while a compiler runs
SYSTEM = ("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32", "/etc/alternatives",
          "/etc/ld.so.cache")
WORKS = {}  # whether a bubblewrap does
KINDS = "auto", "bubblewrap", "plain"


class NoRoom(Exception):
    """There is no such room here; the sentence says why."""


def bound(megabytes, seconds, written):
    """Bounds what this process takes, and how large its files may be."""
    for what, most in ((resource.RLIMIT_AS, megabytes << 20), (resource.RLIMIT_CPU, seconds),
                       (resource.RLIMIT_FSIZE, written), (resource.RLIMIT_CORE, 0)):
        try:
            # A hard bound of time would kill without a word.
            resource.setrlimit(what, (most, most + (what == resource.RLIMIT_CPU)))
        except (ValueError, OSError):
            pass  # macOS has no bound of memory
    signal.signal(signal.SIGXFSZ, signal.SIG_DFL)


def nobody():
    """Returns the number of the user nobody."""
    try:
        return pwd.getpwnam("nobody").pw_uid
    except KeyError:
        return 65534


def within(path, folders):
    """Tells whether a path lies in one of some folders."""
    return any(Path(folder) in (path, *path.parents) for folder in folders)


class Room:
    """A folder, the user it belongs to, and what commands see of the machine."""

    def __init__(self, kind="auto"):
        self.temporary = tempfile.TemporaryDirectory(prefix="judge")  # pylint: disable=R1732
        outside = Path(self.temporary.name)
        outside.chmod(0o711)
        self.folder = outside / "room"
        self.folder.mkdir(mode=0o755)
        self.user = nobody() if os.geteuid() == 0 else None
        if self.user is not None:
            os.chown(self.folder, self.user, -1)
        self.bubblewrap = kind != "plain" and shutil.which("bwrap")
        if self.bubblewrap:
            if self.bubblewrap not in WORKS:  # namespaces may be forbidden, as in many containers
                WORKS[self.bubblewrap] = self.works(["/usr/bin/env", "true"])
            self.bubblewrap = WORKS[self.bubblewrap] and self.bubblewrap
        if kind == "bubblewrap" and not self.bubblewrap:
            raise NoRoom("bubblewrap is not here, or this user may not use it.")

    def name(self):
        """Returns what keeps a program in, for a message."""
        who = "the user nobody" if self.user is not None else "your own user"
        return f"bubblewrap, {who}" if self.bubblewrap else who

    def holds(self):
        """Tells whether a program in this room can neither read nor signal the judge."""
        return bool(self.bubblewrap) or self.user is not None

    def put(self, name, text):
        """Writes a file that commands of the room can read."""
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        path.chmod(0o644)

    def close(self):
        """Takes from the room's user the right to change what was built."""
        if self.user is not None:
            for path in (self.folder, *self.folder.iterdir()):
                if not path.is_symlink():
                    os.chown(path, 0, 0)

    def works(self, command, home=None):
        """Tells whether a command runs in the room and ends well."""
        try:
            return self.run(command, home)[0] == 0
        except (OSError, subprocess.SubprocessError):
            return False

    def inside(self, command, system, writable, home=None):
        """Returns a command as it is started: as it stands, or by bubblewrap.  system: it sees
        the system's programs, and home, a folder of programs elsewhere."""
        if not self.bubblewrap:
            return command
        wrap = [self.bubblewrap, "--unshare-all", "--die-with-parent", "--new-session",
                "--clearenv", "--cap-drop", "ALL"]
        if system:
            for path in SYSTEM:
                wrap += ["--ro-bind-try", path, path]
            if home and not within(home, SYSTEM):
                wrap += ["--ro-bind", str(home), str(home)]
            wrap += ["--dev", "/dev", "--tmpfs", "/tmp", "--setenv", "PATH",
                     f"{home}/bin:/usr/bin:/bin" if home else "/usr/bin:/bin",
                     "--setenv", "LC_ALL", "C"]
        wrap += ["--bind" if writable else "--ro-bind", str(self.folder), "/room", "--chdir",
                 "/room", "--"]
        return wrap + command

    def start(self, command, bounds, system=False, writable=False, home=None, processes=None,
              **streams):
        """Starts a command in the room, bounded before it runs."""
        def before():
            if self.user is not None:
                os.setgroups([])
                os.setgid(self.user)
                os.setuid(self.user)
                if processes:
                    resource.setrlimit(resource.RLIMIT_NPROC, (processes, processes))
            bound(*bounds)
            os.umask(0o022)
        path = os.environ.get("PATH", "/usr/bin:/bin")
        return subprocess.Popen(
            self.inside(command, system, writable, home), cwd=self.folder, start_new_session=True,
            env={"PATH": path, "LC_ALL": "C", "TMPDIR": "/tmp" if self.bubblewrap else
                 str(self.folder)} if system else {}, preexec_fn=before, **streams)

    def run(self, command, home=None, bounds=BUILD):
        """Runs a compiler or the like; returns its exit status and what it says."""
        with tempfile.TemporaryFile() as said:
            child = self.start(command, bounds, system=True, writable=True, home=home,
                               processes=BUILD_PROCESSES, stdin=subprocess.DEVNULL, stdout=said,
                               stderr=said)
            status = self.end(child, time.monotonic() + 4 * bounds[1])
            said.seek(0)
            return status, said.read(1 << 20).decode(errors="replace")

    def end(self, child, until):
        """Waits until a command ends, a second at least, and ends what is left of it.  Returns its
        status, negative for a signal, None where its time is up."""
        try:
            status = child.wait(max(1, until - time.monotonic()))
        except subprocess.TimeoutExpired:
            status = None
        try:
            os.killpg(child.pid, signal.SIGKILL)
        except (ProcessLookupError, PermissionError):
            pass
        child.wait()
        if self.bubblewrap and status is not None and status > 128:
            status = 128 - status  # bubblewrap tells a signal as shells do
        return status

    def python(self, needs=""):
        """Returns a Python that the room's user can run, with the modules it needs: its command
        and its folder."""
        mine = Path(sys.executable).resolve() if sys.executable else None
        for path in (mine, Path("/usr/bin/python3"), Path("/usr/local/bin/python3")):
            home = Path(sys.base_prefix).resolve() if path == mine else None
            command = [str(path), "-I", "-B"]
            if path and self.works([*command, "-c", f"import math{needs}"], home):
                return command, home
        raise NoRoom(f"There is no Python here that {self.name()} can run"
                     f"{' with' + needs.replace(',', '') if needs else ''}.")
