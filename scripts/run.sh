#!/bin/sh
# Runs a program of this repository in an environment of its own (.venv), which the first call makes.
#
#   sh scripts/run.sh reproduce [options]    the main job; any other scripts/NAME.py goes by its name too, with _ or -
#   sh scripts/run.sh test [pytest options]  the tests, in two processes; -m 'not slow' is a quick run of most
#   sh scripts/run.sh docs [sphinx options]  the site, into out/site: runs its tutorials and the examples of the reference
#
# PYTHON chooses the interpreter (3.11 or newer), e.g. PYTHON=python3.12 sh scripts/run.sh test
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P)
venv=$root/.venv

say() { printf '%s\n' "run.sh: $*" >&2; }
fail() { say "$*"; exit 1; }

programs() {
    for file in "$root"/scripts/*.py; do
        name=$(basename "$file" .py)
        case $name in _* | '*') ;; *) printf ' %s' "$name" ;; esac
    done
}

find_python() {
    for candidate in ${PYTHON:-python3 python3.14 python3.13 python3.12 python3.11 python}; do
        if "$candidate" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
            command -v "$candidate"
            return
        fi
    done
    fail "needs Python 3.11 or newer, and found none as ${PYTHON:-python3}; install it, or say PYTHON=/path/to/python3.11 sh scripts/run.sh ..."
}

interpreter() { "$1" -c 'import sys; print(sys.base_prefix, sys.version)' 2>/dev/null; }

# Everything that an environment depends on: it does not survive a move, another interpreter or other dependencies.
wanted_stamp() {
    interpreter "$1"
    printf '%s\n' "$root"
    cat "$root/pyproject.toml" "$root/signimit/__init__.py" | cksum # the latter has the version
}

can_apt() { [ "$(id -u)" -eq 0 ] && command -v apt-get >/dev/null 2>&1; }

apt_install() {
    log=$(mktemp)
    if { apt-get update && DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=60 install -y --no-install-recommends "$@"; } </dev/null >"$log" 2>&1; then
        rm -f "$log"
    else
        tail -n 3 "$log" >&2
        rm -f "$log"
        return 1
    fi
}

has_venv() { "$1" -c 'import venv, ensurepip' 2>/dev/null; }

make_venv() {
    if [ "$(interpreter "$venv/bin/python")" = "$(interpreter "$1")" ] && "$venv/bin/python" -m pip --version >/dev/null 2>&1; then
        return # whole, only its packages may be old
    fi
    if ! has_venv "$1" && can_apt; then
        say "installing python3-venv"
        apt_install python3-venv || true
    fi
    has_venv "$1" || fail "$1 cannot make environments; type: sudo apt-get install python3-venv"
    "$1" -m venv --clear "$venv" || fail "could not make $venv; remove it and try again"
}

# Names a library that renders without a display, or fails: EGL without a vendor's driver renders nothing.
has_gl() {
    "$venv/bin/python" - <<'PYTHON'
import ctypes.util as u, sys
egl = u.find_library("EGL") and (u.find_library("EGL_mesa") or u.find_library("EGL_nvidia"))
sys.exit(sys.platform == "linux" and not (u.find_library("OSMesa") or egl))
PYTHON
}

offer_gl() {
    if has_gl; then
        return
    fi
    if can_apt; then
        say "installing a software OpenGL library"
        apt_install libosmesa6 libegl1 || true
    fi
    has_gl || say "no OpenGL library: going on without video; to have it, type: sudo apt-get install libosmesa6 libegl1"
}

# A browser is wanted by the tests of the studio only; they skip without one.
offer_browser() {
    for name in chromium chromium-browser google-chrome; do
        if command -v "$name" >/dev/null 2>&1; then return; fi
    done
    if can_apt; then
        say "installing a browser for the tests of the studio"
        apt_install chromium || true
    fi
    command -v chromium >/dev/null 2>&1 || say "no Chromium: the studio's page goes untested; to have it, type: sudo apt-get install chromium"
}

# What a program and its subcommand need beside the core.
purpose_of() {
    case "$1 ${2-}" in
        'studio '* | 'timing studio' | 'fuzz studio') printf 'studio' ;;
        'study '* | 'benchmark '* | 'timing growth' | 'results make') printf 'study' ;;
        'convert '* | 'replay '* | 'fuzz '*) printf 'formats' ;;
        *) printf 'run' ;;
    esac
}

extras_for() {
    case $1 in
        run) printf 'scripts,strokes' ;;
        study) printf 'scripts,strokes,study,dask' ;;
        studio) printf 'studio' ;;
        formats) printf 'scripts,strokes,minari,lerobot' ;;
        docs) printf 'docs' ;;
        test) printf 'scripts,strokes,study,studio,minari,lerobot,dask,test' ;;
    esac
}

# Makes the environment for a purpose unless a stamp says that it is there. Stamps are written last, so that a set-up
# that broke off is done again; an environment for one purpose runs plain programs too, one for tests all.
ensure_environment() {
    python=$(find_python)
    wanted=$(wanted_stamp "$python")
    if is_ready "$1"; then
        return
    fi
    if command -v flock >/dev/null 2>&1; then # of two first calls at once the second waits, and finds all done
        exec 9>"$venv.lock"
        flock 9
    fi
    is_ready "$1" || set_up "$1"
    exec 9>&-
}

is_ready() { [ -x "$venv/bin/python" ] && [ "$(cat "$venv/.ready-for-$1" 2>/dev/null)" = "$wanted" ]; }

set_up() {
    say "setting up $venv for this, once; this takes a minute or two"
    make_venv "$python"
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check --editable "${root}[$(extras_for "$1")]" </dev/null ||
        fail "could not install the packages, pip's reason stands above; once it is mended the same command goes on"
    offer_gl
    purposes="run $1"
    if [ "$1" = test ]; then
        offer_browser
        purposes="run study studio formats test"
    fi
    for purpose in $purposes; do printf '%s\n' "$wanted" >"$venv/.ready-for-$purpose"; done
}

# Says what a program does and which options it has, with what is there: nothing is installed for that.
show_help() {
    if [ -x "$venv/bin/python" ] && "$venv/bin/python" -c 'import signimit_envs' 2>/dev/null; then
        exec "$venv/bin/python" "$root/scripts/$what.py" "$@"
    fi
    python=$(find_python)
    if [ "$what" = readme ]; then
        set -- readme "$@"
        what=results
    fi
    exec "$python" "$root/envs/signimit_envs/cli/plain_help.py" "$what" "$@"
}

sphinx() { "$venv/bin/python" -m sphinx --fail-on-warning --keep-going --jobs auto --doctree-dir out/site-cache "$@"; }

# Makes the site, and then runs the examples of the reference; what Sphinx has read for one it knows for the other.
build_site() {
    cd "$root"
    sphinx -b html "$@" docs out/site
    sphinx -q -b doctest docs out/site-cache/doctest
    say "the site is in out/site, its first page is out/site/index.html"
}

usage() { sed -n '2,/^set/s/^# \{0,1\}//p' "$root/scripts/run.sh"; printf 'NAME is one of: test docs%s\n' "$(programs)"; }

[ $# -gt 0 ] || fail "say what to run: sh scripts/run.sh NAME [options], NAME one of: test docs$(programs)"
what=$1
shift
case $what in -h | --help) usage; exit 0 ;; esac
help=
for argument; do case $argument in -h | --help) help=yes ;; esac; done

if [ "$what" = test ] && [ -n "$help" ] && ! "$venv/bin/python" -c 'import pytest' 2>/dev/null; then
    usage # options of pytest are not known before it is installed
    exit 0
fi
if [ "$what" = test ]; then
    [ -n "$help" ] || ensure_environment test
    cd "$root"
    exec "$venv/bin/python" -m pytest -n auto "$@" # two processes, see tests/conftest.py; -n 0: one
fi
if [ "$what" = docs ]; then
    if [ -n "$help" ]; then
        usage
    else
        ensure_environment docs
        build_site "$@"
    fi
    exit 0
fi
what=$(printf '%s' "$what" | tr - _)
case $what in */* | _* | '') fail "there is no program '$what'; there are: test docs$(programs)" ;; esac
[ -f "$root/scripts/$what.py" ] || fail "there is no program '$what'; there are: test docs$(programs)"
[ -z "$help" ] || show_help "$@"
ensure_environment "$(purpose_of "$what" "${1-}")"
exec "$venv/bin/python" "$root/scripts/$what.py" "$@"
