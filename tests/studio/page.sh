#!/bin/sh
# Tests the studio's page: page.sh check|browser PAGE FORAGE SOURCES [TOPIC...], with PAGE the folder of the build that has its node_modules.
# Exit code 77 when Node, the packages or the browser are missing.
command -v node >/dev/null || { echo "SKIPPED: there is no Node"; exit 77; }
[ -d "$2/node_modules/vitest" ] || { echo "SKIPPED: the page was not built, see tools/studio/web"; exit 77; }
export FORAGE_TUTORIAL="$4/docs/tutorial"
rm -rf "$2/tests" && cp -r "$4/tools/studio/web/tests" "$2" && cd "$2" || exit 1
kind=$1 forage=$3 sources=$4
shift 4
case $kind in
    check) npm run --silent check && npm run --silent test ;;
    browser) node tests/browser/run.mjs "$forage" "$sources" "$@" ;;
esac
