# Sourced by tools/figures/jaw-published and knee-published: a table of what is published beside what runs give.
# A row: what | run | columns | which value | published | spread | factor | why it is not in range. A spread is a number, 0: none,
# "most" or "least". What sources this has value RUN COLUMNS WHICH FACTOR, which prints the value of a row in a run or nothing, and
# bar with the same arguments, which prints its error bar or nothing.
# shellcheck shell=bash
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

[ $# -le 1 ] || { echo "usage: tools/figures/$(basename "$0") [OUT]" >&2; exit 2; }
out=${1-out/$(basename "$0")}
articular=${ARTICULAR:-build/release/bin/articular}
if [ ! -x "$articular" ]; then
  echo "$(basename "$0"): no program at $articular: build it with \`tools/build release articular\`, or name one by ARTICULAR" >&2
  exit 2
fi
mkdir -p "$out"

# run NAME SCENARIO ARGUMENT...: unless it has finished before.
run() {
  local name=$1 scenario=$2
  shift 2
  grep -qs '"outcome": "finished"' "$out/$name/summary.json" && return
  "$articular" run "scenarios/$scenario" --out "$out/$name" --overwrite "$@" > /dev/null
}

# error_bar RUN COLUMNS FACTOR: that of columns that are summed, at the end of a run with error bars, or nothing. The bars are
# added: errors may have the same sign.
error_bar() {
  [ -f "$1/error_bars.csv" ] || return 0
  awk -F, -v columns="$2" -v factor="$3" '
    { name = $1; sub(/ \[.*/, "", name); if ($2 == "end") bar[name] = $4 }
    END {
      count = split(columns, wanted, " ")
      for (k = 1; k <= count; ++k) { if (bar[wanted[k]] == "") exit; sum += factor * bar[wanted[k]] }
      if (sum > 0) printf sum < 100 ? " ± %.2g" : " ± %.0f", sum
    }' "$1/error_bars.csv"
}

# verdict VALUE PUBLISHED SPREAD
verdict() {
  awk -v x="$1" -v m="$2" -v s="$3" 'BEGIN {
    if (s == "most") print (x <= m ? "yes" : sprintf("%.1f times", x / m))
    else if (s == "least") print (x > m ? "yes" : "no")
    else {
      d = x > m ? x - m : m - x
      if (s == 0) print sprintf("%.0f %% off", 100 * d / m)
      else print (d <= s ? "yes" : sprintf("off by %.1f spreads", d / s))
    }
  }'
}

# range PUBLISHED SPREAD
range() {
  case $2 in
    most) echo "at most $1" ;;
    least) echo "more than $1" ;;
    0) echo "$1" ;;
    *) echo "$1 ± $2" ;;
  esac
}

# print_table JOINT ROWS: runs of the recorded joint are those of the shipped one with subject- before their names.
print_table() {
  local what name columns which published spread factor why cells verdicts missed prefix here is_in
  echo "| | published | shipped $1 | recorded $1 | in range | why not |"
  echo "|---|---|---|---|---|---|"
  while IFS='|' read -r what name columns which published spread factor why; do
    cells="" verdicts="" missed=""
    for prefix in "" subject-; do
      here=""
      [ -f "$out/$prefix$name/history.csv" ] && here=$(value "$out/$prefix$name" "$columns" "$which" "$factor")
      if [ -z "$here" ]; then cells="$cells | –"; continue; fi
      is_in=$(verdict "$here" "$published" "$spread")
      [ "$is_in" = yes ] || missed=1
      cells="$cells | $(printf '%.3g' "$here")$(bar "$out/$prefix$name" "$columns" "$which" "$factor")"
      verdicts="${verdicts:+$verdicts; }$is_in"
    done
    echo "| $what | $(range "$published" "$spread")$cells | $verdicts | ${missed:+$why} |"
  done <<< "$2"
}
