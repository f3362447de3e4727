# Draws the tables of collision_study; see tools/figures/collision-figures. Needs: out, the folder with the tables.
set datafile separator ','
set fit quiet nolog
set print out.'/fits.md'
queries = out.'/queries.csv'
methods = system("awk -F, 'NR > 1 && !seen[$2]++ { print $2 }' ".queries)
n = words(methods)
colour(m) = word('#c04000 #0060b0 #208020 #806000', m)
# The rows of a series and a method with its number of tetrahedra (column 3) or pairs (4) up to a limit.
rows(series, m, column, limit) = sprintf("< awk -F, '$1 == \"%s\" && $2 == \"%s\" && $%d <= %g' %s", \
  series, word(methods, m), column, limit, queries)

set terminal pngcairo size 750,400 font 'sans,10'
set grid lc rgb '#e0e0e0'
set key under left reverse Left maxrows 3
set style fill transparent solid 0.15 noborder
set ylabel 'query [ms]'
set xlabel offset 0,0.4

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

set output out.'/fig-1.5.4.png'
set multiplot layout 1,2
set xlabel 'tetrahedra in each of two V-shapes, thousands'
figure = '1.5.4 A'; series = 'two_1000'; column_of_x = 3; limit = small; curved = 1
set title '1.5.4 A: 800–1200 intersections'
load panel
figure = '1.5.4 B'; series = 'two_4000'
set title '1.5.4 B: 3200–4800 intersections'
load panel
unset multiplot

set output out.'/fig-1.5.5.png'
set multiplot layout 1,2
set xlabel 'intersections, thousands'
figure = '1.5.5'; series = 'two_small'; column_of_x = 4; limit = everything; curved = 0
set title '1.5.5: two V-shapes of 1000 tetrahedra'
load panel
figure = '1.5.5, large'; series = 'two_large'
set title 'the same with large meshes'
load panel
unset multiplot

set terminal pngcairo size 375,400
set output out.'/fig-1.5.6.png'
set xlabel 'tetrahedra in the V-shape, thousands'
figure = '1.5.6'; series = 'self_1000'; column_of_x = 3; limit = small
set title '1.5.6: 800–1200 self-intersections'
load panel

set terminal pngcairo size 750,400
set output out.'/fig-1.5.7.png'
set multiplot layout 1,2
set xlabel 'self-intersections, thousands'
figure = '1.5.7'; series = 'self_small'; column_of_x = 4; limit = everything
set title '1.5.7: one V-shape of 1000 tetrahedra'
load panel
figure = '1.5.7, large'; series = 'self_large'
set title 'the same with a large mesh'
load panel
unset multiplot

# --- As far as one million tetrahedra.
print ''
print '| as far as the largest mesh | method | fit of the time [ms], x in thousands | one standard deviation | R² |'
print '| --- | --- | --- | ---: | ---: |'
set output out.'/large.png'
set logscale xy
set xrange [*:*]
set yrange [*:*]
set format x '%.0s%c'
set multiplot layout 1,3
set xlabel 'tetrahedra in a body'
panel = 'tools/figures/collision_large.gnuplot'
figure = '1.5.4 A'; series = 'two_1000'
set title 'two, 800–1200 intersections'
load panel
figure = '1.5.4 B'; series = 'two_4000'
set title 'two, 3200–4800 intersections'
load panel
figure = '1.5.6'; series = 'self_1000'
set title 'one, 800–1200'
load panel
unset multiplot

# --- Coordinate sorting.
mapping = out.'/mapping.csv'
sizes = system("awk -F, 'NR > 1 && !seen[$1]++ { print $1 }' ".mapping)
size_rows(i) = sprintf("< awk -F, '$1 == %s' %s", word(sizes, i), mapping)
shade(i) = word('#a0a0a0 #208020 #0060b0 #c04000', i)
set terminal pngcairo size 640,400
set output out.'/mapping.png'
set format x '%g'
set title 'update of a BucketTree: coordinate sorting (lines), direct mapping (dashed)'
set xlabel 'motion of a node from frame to frame, in edges'
set ylabel 'update [ms]'
set key outside right maxrows 10
plot for [i = 1:words(sizes)] size_rows(i) using 2:4 with linespoints pt 7 ps 0.7 lc rgb shade(i) title word(sizes, i), \
  for [i = 1:words(sizes)] size_rows(i) using 2:3 with lines dt 2 lc rgb shade(i) notitle
print ''
print '| tetrahedra | motion [edges] | direct [ms] | sorting [ms] | moves an end | general sorts an update |'
print '| ---: | ---: | ---: | ---: | ---: | ---: |'
print system("awk -F, 'NR > 1 { printf \"%s| %d | %g | %.3g | %.3g | %.3g | %.3g |\", (NR > 2 ? \"\\n\" : \"\"), $1, $2, $3, $4, $5, $6 }' ".mapping)
