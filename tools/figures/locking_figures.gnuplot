# Error of Cook's membrane over 1/(1 − 2ν), at which the axis has ν. Needs: out, the folder of curves.csv.
set terminal svg size 640,400 font 'sans,13'
set output out . '/locking.svg'
set datafile separator ','
names = "'plain' 'NS' 'ES' 'plain + PP 1' 'ES .9 + PP 2'"
colours = "#888888 #d95f02 #1b9e77 #7570b3 #000000"
rows(name) = sprintf("<grep '^%s,' %s/curves.csv", name, out)
set logscale x
set xlabel "Poisson's ratio"
set xtics ('0.3' 2.5, '0.49' 50, '0.499' 500, '0.4999' 5000)
set xrange [2:6500]
set yrange [-75:10]
set ylabel "error of the deflection [%]"
set title "Cook's membrane, 16 x 16 cells of six tetrahedra"
set grid ytics lc rgb '#dddddd'
set key left bottom reverse Left
plot for [i = 1:5] rows(word(names, i)) using (1 / (1 - 2 * $2)):3 with linespoints lw 2 pt 7 ps 0.6 \
  lc rgb word(colours, i) title word(names, i)
