#!/usr/bin/env bash
# Inside xvfb-run: opens a scene in a window, takes a picture, flies forward, takes another, ends with Esc.
# usage: fly_in_window.sh CONELIGHT SCENE FOLDER    leaves FOLDER/start.png, FOLDER/forward.png; the program's status
set -euo pipefail
conelight=$1 scene=$2 folder=$3

"$conelight" run "$scene" --gi cones --quality low --size 320x180 -v 2>"$folder/log" &
program=$!
trap 'kill "$program" 2>/dev/null || true' EXIT
for _ in $(seq 300); do # drawn once the first frame's time is logged
    grep -q '^frame' "$folder/log" && break
    kill -0 "$program" 2>/dev/null || { cat "$folder/log" >&2; exit 1; }
    sleep 0.1
done
window=$(xdotool search --onlyvisible --name Conelight | head -1)
xdotool windowfocus "$window"
import -silent -window "$window" "$folder/start.png"
xdotool keydown w
sleep 2
xdotool keyup w
sleep 0.5
import -silent -window "$window" "$folder/forward.png"
xdotool key Escape
wait "$program"
trap - EXIT
