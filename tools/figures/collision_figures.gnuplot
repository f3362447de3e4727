# Draws the tables of collision_study; see tools/figures/collision-figures. Needs: out, the folder with the tables.
set datafile separator ','
set fit quiet nolog
set print out.'/fits.md'
queries = out.'/queries.csv'
methods = system("awk -F, 'NR > 1 && !seen[$2]++ { print $2 }' ".queries)
n = words(methods)
colour(m) = word('#d55e00 #0072b2 #009e73 #806000', m)
name(m) = word(methods, m) eq 'article' ? 'BucketTree' : word(methods, m) eq 'blocks' ? 'BlockTree' : word(methods, m)
# The rows of a series and a method with its number of tetrahedra (column 3) or pairs (4) up to a limit.
rows(series, m, column, limit) = sprintf("< awk -F, '$1 == \"%s\" && $2 == \"%s\" && $%d <= %g' %s", \
  series, word(methods, m), column, limit, queries)

font = "font 'sans,11' background rgb 'white'"
wide = "svg size 760,360 ".font
eval 'set terminal '.wide
set grid lc rgb '#dddddd'
set key top left reverse Left samplen 1.5 spacing 1.1
set style fill transparent solid 0.15 noborder
set ylabel 'query [ms]'

# --- Figures 1.5.4 to 1.5.7: meshes as small as the article's.
print '| figure | method | fit of the time [ms], x in thousands | one standard deviation [ms] | R² |'
print '| --- | --- | --- | ---: | ---: |'
array c0[n]; array c1[n]; array c_sd[n]; array c_r2[n]
array q0[n]; array q1[n]; array q2[n]; array q_sd[n]; array q_r2[n]
line(m, x) = c0[m] + c1[m] * x
parabola(m, x) = q0[m] + (q1[m] + q2[m] * x) * x
panel = 'tools/figures/collision_panel.gnuplot'
small = 21000
everything = 1e9

set output out.'/fig-1.5.4.svg'
set multiplot layout 1,2
set xlabel 'tetrahedra in each of two V-shapes, thousands'
figure = '1.5.4 A'; series = 'two_1000'; column_of_x = 3; limit = small; curved = 1
set title '800–1200 intersections'
load panel
figure = '1.5.4 B'; series = 'two_4000'
set title '3200–4800 intersections'
load panel
unset multiplot

set output out.'/fig-1.5.5.svg'
set multiplot layout 1,2
set xlabel 'intersections, thousands'
figure = '1.5.5'; series = 'two_small'; column_of_x = 4; limit = everything; curved = 0
set title 'two V-shapes of 1000 tetrahedra'
load panel
figure = '1.5.5, large'; series = 'two_large'
set title 'of 100,000 tetrahedra'
load panel
unset multiplot

eval 'set terminal svg size 380,360 '.font
set output out.'/fig-1.5.6.svg'
set xlabel 'tetrahedra in the V-shape, thousands'
figure = '1.5.6'; series = 'self_1000'; column_of_x = 3; limit = small
set title '800–1200 self-intersections'
load panel

eval 'set terminal '.wide
set output out.'/fig-1.5.7.svg'
set multiplot layout 1,2
set xlabel 'self-intersections, thousands'
figure = '1.5.7'; series = 'self_small'; column_of_x = 4; limit = everything
set title 'one V-shape of 1000 tetrahedra'
load panel
figure = '1.5.7, large'; series = 'self_large'
set title 'of 100,000 tetrahedra'
load panel
unset multiplot

# --- As far as one million tetrahedra.
print ''
print '| as far as the largest mesh | method | fit of the time [ms], x in thousands | one standard deviation | R² |'
print '| --- | --- | --- | ---: | ---: |'
eval 'set terminal svg size 960,360 '.font
set output out.'/large.svg'
set logscale xy
unset offsets
set xrange [*:*]
set yrange [*:*]
set format x '%.0s%c'
set multiplot layout 1,3
set xlabel 'tetrahedra in a body'
panel = 'tools/figures/collision_large.gnuplot'
figure = '1.5.4 A'; series = 'two_1000'
set title 'two V-shapes, 800–1200 intersections'
load panel
figure = '1.5.4 B'; series = 'two_4000'
set title 'two, 3200–4800 intersections'
load panel
figure = '1.5.6'; series = 'self_1000'
set title 'one with itself, 800–1200'
load panel
unset multiplot

# --- Coordinate sorting.
mapping = out.'/mapping.csv'
sizes = system("awk -F, 'NR > 1 && !seen[$1]++ { print $1 }' ".mapping)
size_rows(i) = sprintf("< awk -F, '$1 == %s' %s", word(sizes, i), mapping)
shade(i) = word('#999999 #009e73 #0072b2 #d55e00', i)
eval 'set terminal svg size 640,400 '.font
set output out.'/mapping.svg'
set format x '%g'
unset title
set xlabel 'motion of a node from frame to frame [edge lengths]'
set ylabel 'update of a BucketTree [ms]'
set key outside right center
last = words(sizes)
plot for [i = last:1:-1] size_rows(i) using 2:4 with linespoints pt 7 ps 0.5 lw 1.5 lc rgb shade(i) title word(sizes, i).' tetrahedra', \
  for [i = 1:last] size_rows(i) using 2:3 with lines dt 2 lw 1.5 lc rgb shade(i) notitle, \
  NaN with linespoints pt 7 ps 0.5 lw 1.5 lc 'black' title 'coordinate sorting', \
  NaN with lines dt 2 lw 1.5 lc 'black' title 'direct mapping'
print ''
print '| tetrahedra | motion [edges] | direct [ms] | sorting [ms] | moves an end | general sorts an update |'
print '| ---: | ---: | ---: | ---: | ---: | ---: |'
print system("awk -F, 'NR > 1 { printf \"%s| %d | %g | %.3g | %.3g | %.3g | %.3g |\", (NR > 2 ? \"\\n\" : \"\"), $1, $2, $3, $4, $5, $6 }' ".mapping)
