#!/bin/sh
# Tries every guarded kernel of a folder that `hairline repair --scalar f32,f64 --emit c -o FOLDER/` wrote on adversarial rays:
#
#     tests/repair/run.sh FOLDER [THREADS [COUNT [SEED]]]
#
# Needs a C compiler (CC, CFLAGS) only. Ends with 1 if an answer is wrong.
set -u
here=$(dirname "$0")
folder=$1
failed=0
for file in "$folder"/*.h; do
    kernel=$(basename "$file" .h)
    case $kernel in *_f64) double=1 ;; *) double=0 ;; esac
    case $(sed -n 's/^ \* promise: //p' "$file") in
    "line, both sides") promise="-DEXTENT=0 -DFRONT=0" ;;
    "line, front") promise="-DEXTENT=0 -DFRONT=1" ;;
    "ray, both sides") promise="-DEXTENT=1 -DFRONT=0" ;;
    "ray, front") promise="-DEXTENT=1 -DFRONT=1" ;;
    "interval, both sides") promise="-DEXTENT=2 -DFRONT=0" ;;
    "interval, front") promise="-DEXTENT=2 -DFRONT=1" ;;
    *) echo "$file: no promise that this script knows" >&2; exit 2 ;;
    esac
    ${CC:-cc} ${CFLAGS:--O2} -pthread -include "$file" -DKERNEL="$kernel" -DDOUBLE=$double $promise \
        -o "$folder/$kernel.check" "$here/check.c" -lm || exit 2
    echo "$kernel"
    "$folder/$kernel.check" "${2:-1}" "${3:-1000000}" "${4:-1}" || failed=1
done
exit $failed
