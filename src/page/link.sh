#!/bin/sh
# The linker of build.sh. Crates between argmin and the clock export a thousand functions for a tool that is not used
# here; without their exports the linker leaves them out.
set -eu
linker=${WASM_LD:-$(rustc --print sysroot)/lib/rustlib/$(rustc -vV | sed -n 's/^host: //p')/bin/gcc-ld/wasm-ld}
# Debian's compiler comes without one
[ -x "$linker" ] || linker=$(ls /usr/lib/llvm-*/bin/wasm-ld | tail -n 1)
count=$#
before=
while [ "$count" -gt 0 ]; do
    argument=$1
    shift
    count=$((count - 1))
    case "$before$argument" in
        --export=__wb* | --export__wb* | -flavor | -flavorwasm) ;;
        --export) ;;
        --export*) case "$before" in
            --export) set -- "$@" --export "$argument" ;;
            *) set -- "$@" "$argument" ;;
            esac ;;
        *) set -- "$@" "$argument" ;;
    esac
    case "$argument" in --export | -flavor) before=$argument ;; *) before= ;; esac
done
exec "$linker" "$@"
