#!/bin/sh
# The suite `unit` of a build on an emulated processor with SSE2 to SSE4.2 only: no AVX, and no
# fused multiply-add in the C library.  Status 77, with the reason: it cannot be done here.
# Usage: emulated.sh BUILD
set -eu

if ! command -v qemu-x86_64 >/dev/null || [ "$(uname -m)" != x86_64 ]; then
    echo 'skipped: no qemu-x86_64 (Debian: qemu-user)'
    exit 77
fi
meson test -C "$1" --no-rebuild --suite unit --timeout-multiplier 0 --logbase emulated \
    --wrapper 'qemu-x86_64 -cpu Nehalem' --print-errorlogs
