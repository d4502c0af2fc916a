#!/bin/sh
# Tests the studio's page: page.sh check|browser PAGE FORAGE SOURCES [TOPIC...], with PAGE the folder of the build that has its node_modules.
# Exit code 77 when Node, the packages or the browser are missing.
command -v node >/dev/null || { echo "SKIPPED: there is no Node"; exit 77; }
[ -d "$2/node_modules/vitest" ] || { echo "SKIPPED: the page was not built, see tools/studio/web"; exit 77; }
export FORAGE_TUTORIAL="$4/docs/tutorial"
kind=$1 page=$2 forage=$3 sources=$4
shift 4
# Tests that run at the same time copy different folders.
case $kind in check) tests=tests ;; browser) tests=tests/browser ;; esac
rm -rf "$page/${tests##*/}" && cp -r "$sources/tools/studio/web/$tests" "$page" && cd "$page" || exit 1
case $kind in
    check) npm run --silent check && npm run --silent test ;;
    browser) node browser/run.mjs "$forage" "$sources" "$@" ;;
esac
