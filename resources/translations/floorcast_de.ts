<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
 <context>
  <name>Floorcast</name>
  <message numerus="yes">
   <source>%Ln door(s)</source>
   <translation>
    <numerusform>%Ln Tür</numerusform>
    <numerusform>%Ln Türen</numerusform>
   </translation>
  </message>
  <message numerus="yes">
   <source>%Ln plane(s)</source>
   <translation>
    <numerusform>%Ln Ebene</numerusform>
    <numerusform>%Ln Ebenen</numerusform>
   </translation>
  </message>
  <message numerus="yes">
   <source>%Ln point(s)</source>
   <translation>
    <numerusform>%Ln Punkt</numerusform>
    <numerusform>%Ln Punkte</numerusform>
   </translation>
  </message>
  <message numerus="yes">
   <source>%Ln region(s)</source>
   <translation>
    <numerusform>%Ln Region</numerusform>
    <numerusform>%Ln Regionen</numerusform>
   </translation>
  </message>
  <message>
   <source>3D view</source>
   <translation>3D-Ansicht</translation>
  </message>
  <message>
   <source>95 % of its points lie closer</source>
   <translation>95 % der Punkte liegen näher</translation>
  </message>
  <message>
   <source>95 % of the points lie closer than this</source>
   <translation>95 % der Punkte liegen näher als dies</translation>
  </message>
  <message>
   <source>95 % within {band}</source>
   <translation>95 % innerhalb {band}</translation>
  </message>
  <message>
   <source>; {0} mends one that was cut off</source>
   <translation>; {0} heilt eine, die abgebrochen wurde</translation>
  </message>
  <message>
   <source>A CAD drawing in metres: walls, doors, areas, dimensions; predicted parts on layers of their own.</source>
   <translation>Eine CAD-Zeichnung in Metern: Wände, Türen, Flächen, Maße; Vorhergesagtes auf eigenen Layern.</translation>
  </message>
  <message>
   <source>A building model: spaces, walls, doors; predicted walls on a layer of their own.</source>
   <translation>Ein Gebäudemodell: Räume, Wände, Türen; vorhergesagte Wände auf eigener Ebene.</translation>
  </message>
  <message>
   <source>A building of {0} x {1} m that stands apart gives no plan: {2}</source>
   <translation>Ein Gebäude von {0} x {1} m, das für sich steht, ergibt keinen Plan: {2}</translation>
  </message>
  <message>
   <source>A chunk of the recording was refused: {0} bytes unpack to more than {1}, which no sensor writes.</source>
   <translation>Ein Block der Aufzeichnung wurde abgelehnt: {0} Bytes ergeben entpackt mehr als {1}, wie es kein Sensor schreibt.</translation>
  </message>
  <message>
   <source>A corridor opens into a hall</source>
   <translation>Ein Flur mündet in eine Halle</translation>
  </message>
  <message>
   <source>A corridor up to this wide ends where it opens into a hall.</source>
   <translation>Ein Flur bis zu dieser Breite endet, wo er in eine Halle mündet.</translation>
  </message>
  <message>
   <source>A depth image has the form {0}; of compressed ones only PNG is read: republish the images uncompressed.</source>
   <translation>Ein Tiefenbild hat die Form {0}; von den komprimierten wird nur PNG gelesen: die Bilder unkomprimiert veröffentlichen.</translation>
  </message>
  <message>
   <source>A distance between two points.</source>
   <translation>Ein Abstand zwischen zwei Punkten.</translation>
  </message>
  <message>
   <source>A door cannot be {0} m wide.</source>
   <translation>Eine Tür kann nicht {0} m breit sein.</translation>
  </message>
  <message>
   <source>A door is a 'door' or an 'opening', not {0}.</source>
   <translation>Eine Tür ist „door“ oder „opening“, nicht {0}.</translation>
  </message>
  <message>
   <source>A door, or an opening: wider, or without a lintel</source>
   <translation>Eine Tür oder eine Öffnung: breiter oder ohne Sturz</translation>
  </message>
  <message>
   <source>A drawing at a usual scale: walls, doors, areas, dimensions, seen and predicted told apart.</source>
   <translation>Eine Zeichnung in üblichem Maßstab: Wände, Türen, Flächen, Maße, Gesehenes und Vorhergesagtes unterschieden.</translation>
  </message>
  <message>
   <source>A label is a word, like room or corridor.</source>
   <translation>Eine Bezeichnung ist ein Wort wie room oder corridor.</translation>
  </message>
  <message>
   <source>A larger turning distance to the square is a corridor (paper: 1).</source>
   <translation>Ein größerer Drehabstand zum Quadrat ist ein Flur (Artikel: 1).</translation>
  </message>
  <message>
   <source>A lintel less deep is shallow.</source>
   <translation>Ein Sturz von weniger Tiefe ist flach.</translation>
  </message>
  <message>
   <source>A longer boundary is a corridor (paper: 60 m).</source>
   <translation>Ein längerer Umriss ist ein Flur (Artikel: 60 m).</translation>
  </message>
  <message>
   <source>A measured length must be above 0 m, not {0}.</source>
   <translation>Eine gemessene Länge muss über 0 m sein, nicht {0}.</translation>
  </message>
  <message>
   <source>A name must not be empty.</source>
   <translation>Ein Name darf nicht leer sein.</translation>
  </message>
  <message>
   <source>A normal this near to an axis supports the frame.</source>
   <translation>Eine Normale, die so nahe an einer Achse liegt, stützt das Achsensystem.</translation>
  </message>
  <message>
   <source>A person says so</source>
   <translation>Ein Mensch sagt es</translation>
  </message>
  <message>
   <source>A picture has 16 to 16384 pixels a side (asked: {0} x {1}).</source>
   <translation>Ein Bild hat 16 bis 16384 Pixel je Seite (verlangt: {0} x {1}).</translation>
  </message>
  <message>
   <source>A picture of one pane at any resolution.</source>
   <translation>Ein Bild einer Ansicht in beliebiger Auflösung.</translation>
  </message>
  <message>
   <source>A place is two numbers in metres, like (1.5, 2.0); given {0}.</source>
   <translation>Ein Ort sind zwei Zahlen in Metern wie (1.5, 2.0); gegeben war {0}.</translation>
  </message>
  <message>
   <source>A planar scan: walls and furniture alike are taken to reach from floor to ceiling.</source>
   <translation>Ein ebener Scan: Wände wie Möbel gelten als raumhoch.</translation>
  </message>
  <message>
   <source>A point of {0} refers to scan {1}; scan ids count from 0.</source>
   <translation>Ein Punkt von {0} bezieht sich auf Scan {1}; Scans zählen ab 0.</translation>
  </message>
  <message>
   <source>A pose must be a 4 x 4 matrix of finite numbers (given {0}).</source>
   <translation>Eine Pose muss eine Matrix von 4 x 4 endlichen Zahlen sein (angegeben: {0}).</translation>
  </message>
  <message>
   <source>A pose must be a rotation (3 x 3, not scaled or mirrored) with the sensor's position in metres in its last column and 0, 0, 0, 1 below (given {0}).</source>
   <translation>Eine Pose muss eine Drehung sein (3 x 3, weder skaliert noch gespiegelt), mit der Position des Sensors in Metern in der letzten Spalte und 0, 0, 0, 1 darunter (angegeben: {0}).</translation>
  </message>
  <message>
   <source>A resolution of {0} m a pixel for {1} is not between {2} and {3}; it is in metres, like 0.05.</source>
   <translation>Eine Auflösung von {0} m je Pixel für {1} liegt nicht zwischen {2} und {3}; sie wird in Metern angegeben, etwa 0.05.</translation>
  </message>
  <message>
   <source>A shut leaf closes it</source>
   <translation>Ein geschlossenes Türblatt füllt sie</translation>
  </message>
  <message>
   <source>A surface that ends less than this below the ceiling touches it.</source>
   <translation>Eine Fläche, die weniger als dies unter der Decke endet, berührt sie.</translation>
  </message>
  <message>
   <source>A surface that reaches above this is no furniture.</source>
   <translation>Eine Fläche, die höher reicht, ist kein Möbel.</translation>
  </message>
  <message>
   <source>A terrestrial scanner sees a wall to millimetres; narrow tolerances tell a recess from its wall.</source>
   <translation>Ein Standscanner misst eine Wand auf Millimeter; enge Toleranzen trennen eine Nische von ihrer Wand.</translation>
  </message>
  <message>
   <source>A wall of {0} m is no wall: its thickness is between 0 and {1} m.</source>
   <translation>Eine Wand von {0} m ist keine: Ihre Dicke liegt zwischen 0 und {1} m.</translation>
  </message>
  <message>
   <source>A wider lintel between two walls that go on beyond it is a beam, and separates nothing.</source>
   <translation>Ein breiterer Sturz zwischen zwei Wänden, die dahinter weitergehen, ist ein Unterzug und trennt nichts.</translation>
  </message>
  <message>
   <source>A wing of {0} m2 at {1} degrees gives no plan: {2}</source>
   <translation>Ein Gebäudeflügel von {0} m2 unter {1} Grad ergibt keinen Plan: {2}</translation>
  </message>
  <message>
   <source>A wing of {0} m2 stands at {1} degrees to the rest: it is planned in a frame of its own.</source>
   <translation>Ein Flügel von {0} m² steht um {1} Grad gedreht zum Rest: Er wird in einem eigenen Achsenkreuz geplant.</translation>
  </message>
  <message>
   <source>A3 at 300 dpi</source>
   <translation>A3 mit 300 dpi</translation>
  </message>
  <message>
   <source>About Floorcast</source>
   <translation>Über Floorcast</translation>
  </message>
  <message>
   <source>Above the floor</source>
   <translation>Über dem Boden</translation>
  </message>
  <message>
   <source>Accept door</source>
   <translation>Tür bestätigen</translation>
  </message>
  <message>
   <source>Accept {0}</source>
   <translation>{0} bestätigen</translation>
  </message>
  <message>
   <source>Accepted by hand</source>
   <translation>Von Hand bestätigt</translation>
  </message>
  <message>
   <source>Add a measurement…</source>
   <translation>Messung hinzufügen…</translation>
  </message>
  <message>
   <source>Add door</source>
   <translation>Tür hinzufügen</translation>
  </message>
  <message>
   <source>Add wall</source>
   <translation>Wand hinzufügen</translation>
  </message>
  <message>
   <source>Added by hand</source>
   <translation>Von Hand hinzugefügt</translation>
  </message>
  <message>
   <source>Agreement</source>
   <translation>Übereinstimmung</translation>
  </message>
  <message>
   <source>All files</source>
   <translation>Alle Dateien</translation>
  </message>
  <message>
   <source>All points of {0} that were looked at are marked as invalid.</source>
   <translation>Alle Punkte von {0}, die angesehen wurden, sind als ungültig markiert.</translation>
  </message>
  <message>
   <source>All settings as they come.</source>
   <translation>Alle Einstellungen wie geliefert.</translation>
  </message>
  <message>
   <source>All shortcuts and gestures on one sheet.</source>
   <translation>Alle Tastenkürzel und Gesten auf einem Blatt.</translation>
  </message>
  <message>
   <source>All steps so far; click one to go back to it.</source>
   <translation>Alle bisherigen Schritte; ein Klick führt dorthin zurück.</translation>
  </message>
  <message>
   <source>Along the way it faces</source>
   <translation>In der Richtung, in die sie weist</translation>
  </message>
  <message>
   <source>An observed offset may differ this much from its plane (3 sigma).</source>
   <translation>So weit darf eine gemessene Lage von ihrer Ebene abweichen (3 Sigma).</translation>
  </message>
  <message>
   <source>An occupancy grid for robots (YAML and PGM): what was seen; all else is unknown.</source>
   <translation>Eine Belegungskarte für Roboter (YAML und PGM): was gesehen wurde; alles andere ist unbekannt.</translation>
  </message>
  <message>
   <source>Angle</source>
   <translation>Winkel</translation>
  </message>
  <message>
   <source>Aperture</source>
   <translation>Öffnungsbreite</translation>
  </message>
  <message>
   <source>Area</source>
   <translation>Fläche</translation>
  </message>
  <message>
   <source>As in the paper</source>
   <translation>Wie im Artikel</translation>
  </message>
  <message>
   <source>As it was at first</source>
   <translation>Wie am Anfang</translation>
  </message>
  <message>
   <source>As the system</source>
   <translation>Wie das System</translation>
  </message>
  <message>
   <source>Auto</source>
   <translation>Auto</translation>
  </message>
  <message>
   <source>Automatic</source>
   <translation>Automatisch</translation>
  </message>
  <message>
   <source>Autosave</source>
   <translation>Sichern</translation>
  </message>
  <message>
   <source>Back to the plan of all that was measured</source>
   <translation>Zurück zum Plan aus allem, was gemessen wurde</translation>
  </message>
  <message>
   <source>Back to {value}</source>
   <translation>Zurück auf {value}</translation>
  </message>
  <message>
   <source>Below this share of supporting wall there is no Manhattan frame.</source>
   <translation>Stützt ein kleinerer Anteil der Wände, gibt es kein Manhattan-Achsensystem.</translation>
  </message>
  <message>
   <source>Bin</source>
   <translation>Klassenbreite</translation>
  </message>
  <message>
   <source>Bridge</source>
   <translation>Überbrückung</translation>
  </message>
  <message>
   <source>Bring it into view</source>
   <translation>Ins Bild holen</translation>
  </message>
  <message>
   <source>Bring one pane to the front.</source>
   <translation>Eine Ansicht nach vorne holen.</translation>
  </message>
  <message>
   <source>Bring the selected thing into view.</source>
   <translation>Das Gewählte ins Bild holen.</translation>
  </message>
  <message>
   <source>Bring the whole plan into view.</source>
   <translation>Den ganzen Plan ins Bild holen.</translation>
  </message>
  <message>
   <source>By hand</source>
   <translation>Von Hand</translation>
  </message>
  <message>
   <source>CARMEN log</source>
   <translation>CARMEN-Protokoll</translation>
  </message>
  <message>
   <source>CARMEN logs: planar scans with corrected poses, also gzipped</source>
   <translation>CARMEN-Protokolle: ebene Scans mit korrigierten Posen, auch mit gzip gepackt</translation>
  </message>
  <message>
   <source>Camera, ceiling cut and section box by numbers.</source>
   <translation>Kamera, Deckenschnitt und Schnittquader nach Zahlen.</translation>
  </message>
  <message>
   <source>Cancel</source>
   <translation>Abbrechen</translation>
  </message>
  <message>
   <source>Cancel (Esc)</source>
   <translation>Abbrechen (Esc)</translation>
  </message>
  <message>
   <source>Cancel the work, then the gesture, then the selection</source>
   <translation>Bricht die Arbeit ab, dann die Geste, dann die Auswahl</translation>
  </message>
  <message>
   <source>Cancelled.</source>
   <translation>Abgebrochen.</translation>
  </message>
  <message>
   <source>Candidate rectangles</source>
   <translation>Kandidatenrechtecke</translation>
  </message>
  <message>
   <source>Candidate rectangles and their pruning.</source>
   <translation>Kandidatenrechtecke und ihre Auslese.</translation>
  </message>
  <message>
   <source>Candidates</source>
   <translation>Kandidaten</translation>
  </message>
  <message>
   <source>Candidates that the greedy cover chose</source>
   <translation>Kandidaten, die die gierige Überdeckung gewählt hat</translation>
  </message>
  <message>
   <source>Cannot read the depth image {0}: {1}.</source>
   <translation>Das Tiefenbild {0} lässt sich nicht lesen: {1}.</translation>
  </message>
  <message>
   <source>Cannot read the folder {0}: {1}.</source>
   <translation>Der Ordner {0} lässt sich nicht lesen: {1}.</translation>
  </message>
  <message>
   <source>Cannot read the trajectory {0}: {1}.</source>
   <translation>Die Trajektorie {0} lässt sich nicht lesen: {1}.</translation>
  </message>
  <message>
   <source>Cannot read the {0} {1}: {2}.</source>
   <translation>Die {0} {1} lässt sich nicht lesen: {2}.</translation>
  </message>
  <message>
   <source>Cannot read {0}: {1}.</source>
   <translation>{0} lässt sich nicht lesen: {1}.</translation>
  </message>
  <message>
   <source>Cannot write the picture {0}.</source>
   <translation>Das Bild {0} kann nicht geschrieben werden.</translation>
  </message>
  <message>
   <source>Cannot write {0}: {1}.</source>
   <translation>{0} lässt sich nicht schreiben: {1}.</translation>
  </message>
  <message>
   <source>Ceiling cut</source>
   <translation>Deckenschnitt</translation>
  </message>
  <message>
   <source>Ceiling gap</source>
   <translation>Abstand zur Decke</translation>
  </message>
  <message>
   <source>Cell</source>
   <translation>Zelle</translation>
  </message>
  <message>
   <source>Cells</source>
   <translation>Zellen</translation>
  </message>
  <message>
   <source>Cells in which normals are fitted.</source>
   <translation>Zellen, in denen Normalen bestimmt werden.</translation>
  </message>
  <message>
   <source>Change a setting…</source>
   <translation>Einstellung ändern…</translation>
  </message>
  <message>
   <source>Change one number of the method; only what depends on it is planned again.</source>
   <translation>Eine Zahl des Verfahrens ändern; nur was davon abhängt, wird neu geplant.</translation>
  </message>
  <message>
   <source>Change several settings in one step.</source>
   <translation>Mehrere Einstellungen in einem Schritt ändern.</translation>
  </message>
  <message>
   <source>Changed</source>
   <translation>Geändert</translation>
  </message>
  <message>
   <source>Check</source>
   <translation>Messung</translation>
  </message>
  <message>
   <source>Check {name}</source>
   <translation>Messung {name}</translation>
  </message>
  <message>
   <source>Classifier</source>
   <translation>Klassifikator</translation>
  </message>
  <message>
   <source>Clear the selection (Esc does it, too).</source>
   <translation>Die Auswahl aufheben (auch mit Esc).</translation>
  </message>
  <message>
   <source>Click</source>
   <translation>Klick</translation>
  </message>
  <message>
   <source>Click a region, then the region that it is one with.</source>
   <translation>Eine Region anklicken, dann die, mit der sie eins ist.</translation>
  </message>
  <message>
   <source>Click both jambs on a wall, or type the width. Drag the ends of the selected door.</source>
   <translation>Beide Laibungen auf einer Wand anklicken oder die Breite tippen. Enden der gewählten Tür ziehen.</translation>
  </message>
  <message>
   <source>Click corners and press Enter, or double-click a region. A measures distances again.</source>
   <translation>Ecken anklicken und Eingabe drücken oder eine Region doppelt anklicken. A misst wieder Strecken.</translation>
  </message>
  <message>
   <source>Click on a wall: a door needs one.</source>
   <translation>Auf eine Wand klicken: Eine Tür braucht eine.</translation>
  </message>
  <message>
   <source>Click on two sides of a region: it is cut along the line.</source>
   <translation>Zwei Seiten einer Region anklicken: Sie wird entlang der Linie geteilt.</translation>
  </message>
  <message>
   <source>Click to select, drag what is selected.</source>
   <translation>Klicken wählt, das Gewählte lässt sich ziehen.</translation>
  </message>
  <message>
   <source>Click two points; walls, corners and jambs snap, Shift measures square. A measures an area.</source>
   <translation>Zwei Punkte anklicken; Wände, Ecken und Laibungen fangen, Umschalt misst rechtwinklig. A misst eine Fläche.</translation>
  </message>
  <message>
   <source>Click two regions that are one.</source>
   <translation>Zwei Regionen anklicken, die eine sind.</translation>
  </message>
  <message>
   <source>Click where the wall begins and where it ends. Type a length to be exact.</source>
   <translation>Anfang und Ende der Wand anklicken. Eine getippte Länge gilt genau.</translation>
  </message>
  <message>
   <source>Close</source>
   <translation>Schließen</translation>
  </message>
  <message>
   <source>Close the program.</source>
   <translation>Das Programm beenden.</translation>
  </message>
  <message>
   <source>Close the survey.</source>
   <translation>Die Aufnahme schließen.</translation>
  </message>
  <message>
   <source>Close without saving?</source>
   <translation>Ohne Speichern schließen?</translation>
  </message>
  <message>
   <source>Colour the points by facing.</source>
   <translation>Die Punkte nach Richtung färben.</translation>
  </message>
  <message>
   <source>Colour the points by height.</source>
   <translation>Die Punkte nach Höhe färben.</translation>
  </message>
  <message>
   <source>Colour the points by intensity.</source>
   <translation>Die Punkte nach Intensität färben.</translation>
  </message>
  <message>
   <source>Colour the points by its own colour.</source>
   <translation>Die Punkte in eigener Farbe zeigen.</translation>
  </message>
  <message>
   <source>Colour the points by plane.</source>
   <translation>Die Punkte nach Ebene färben.</translation>
  </message>
  <message>
   <source>Colour the points by {0}.</source>
   <translation>Die Punkte nach {0} färben.</translation>
  </message>
  <message>
   <source>Commas in {0} are decimal commas.</source>
   <translation>Kommas in {0} sind Dezimalkommas.</translation>
  </message>
  <message>
   <source>Compact isolated objects up to this size are furniture or columns.</source>
   <translation>Kompakte freistehende Objekte bis zu dieser Größe sind Möbel oder Stützen.</translation>
  </message>
  <message>
   <source>Confidence</source>
   <translation>Sicherheit</translation>
  </message>
  <message>
   <source>Coordinates are in {0}, as asked.</source>
   <translation>Die Koordinaten sind {0}, wie verlangt.</translation>
  </message>
  <message>
   <source>Coordinates are in {0}, {1}.</source>
   <translation>Die Koordinaten sind {0}, {1}.</translation>
  </message>
  <message>
   <source>Coordinates are in {0}; this is kept for export.</source>
   <translation>Die Koordinaten sind in {0}; das bleibt für den Export erhalten.</translation>
  </message>
  <message>
   <source>Coordinates are large: ({0}, {1}, {2}) m is subtracted inside and restored in every export.</source>
   <translation>Die Koordinaten sind groß: ({0}, {1}, {2}) m werden intern abgezogen und in jedem Export wieder zugefügt.</translation>
  </message>
  <message>
   <source>Coordinates are taken as {0} ({1}); force it with input.unit.</source>
   <translation>Die Koordinaten gelten als {0} ({1}); vorgeben mit input.unit.</translation>
  </message>
  <message>
   <source>Copy</source>
   <translation>Kopieren</translation>
  </message>
  <message>
   <source>Copy picture</source>
   <translation>Bild kopieren</translation>
  </message>
  <message>
   <source>Corner</source>
   <translation>Ecke</translation>
  </message>
  <message>
   <source>Correct</source>
   <translation>Korrigieren</translation>
  </message>
  <message>
   <source>Corrected</source>
   <translation>Korrigiert</translation>
  </message>
  <message>
   <source>Correcting the path</source>
   <translation>Weg wird korrigiert</translation>
  </message>
  <message>
   <source>Correction</source>
   <translation>Korrektur</translation>
  </message>
  <message>
   <source>Correction of a drifting trajectory (SL-LMS), before the points are put together.</source>
   <translation>Korrektur einer driftenden Trajektorie (SL-LMS), bevor die Punkte zusammengesetzt werden.</translation>
  </message>
  <message>
   <source>Correction {0} ({1}) is damaged: {2}.</source>
   <translation>Korrektur {0} ({1}) ist beschädigt: {2}.</translation>
  </message>
  <message>
   <source>Correction {0} is of an unknown kind ({1}).</source>
   <translation>Korrektur {0} ist von unbekannter Art ({1}).</translation>
  </message>
  <message>
   <source>Corridor</source>
   <translation>Flur</translation>
  </message>
  <message>
   <source>Corridor {0}</source>
   <translation>Flur {0}</translation>
  </message>
  <message>
   <source>Cover</source>
   <translation>Überdeckung</translation>
  </message>
  <message>
   <source>Covering the free space</source>
   <translation>Freiraum überdecken</translation>
  </message>
  <message>
   <source>Crop height</source>
   <translation>Schnitthöhe</translation>
  </message>
  <message>
   <source>Dark</source>
   <translation>Dunkel</translation>
  </message>
  <message>
   <source>Dark colours for dark rooms.</source>
   <translation>Dunkle Farben für dunkle Räume.</translation>
  </message>
  <message>
   <source>Delete</source>
   <translation>Löschen</translation>
  </message>
  <message>
   <source>Depth camera, noisy</source>
   <translation>Tiefenkamera, verrauscht</translation>
  </message>
  <message>
   <source>Depth images with poses: TUM, ScanNet-like, 7-Scenes, Open3D and Redwood folders</source>
   <translation>Tiefenbilder mit Posen: Ordner von TUM, ScanNet und ähnlichen, 7-Scenes, Open3D und Redwood</translation>
  </message>
  <message>
   <source>Deutsch</source>
   <translation>Deutsch</translation>
  </message>
  <message>
   <source>Dimensions</source>
   <translation>Maße</translation>
  </message>
  <message>
   <source>Discard</source>
   <translation>Verwerfen</translation>
  </message>
  <message>
   <source>Dismiss</source>
   <translation>Ausblenden</translation>
  </message>
  <message>
   <source>Distance between the two points on the plan</source>
   <translation>Abstand der beiden Punkte im Plan</translation>
  </message>
  <message>
   <source>Do again what was taken back.</source>
   <translation>Das Zurückgenommene wiederholen.</translation>
  </message>
  <message>
   <source>Door</source>
   <translation>Tür</translation>
  </message>
  <message>
   <source>Door evidence</source>
   <translation>Türbelege</translation>
  </message>
  <message>
   <source>Door opening</source>
   <translation>Türverengung</translation>
  </message>
  <message>
   <source>Door wall</source>
   <translation>Wandanteil an Türen</translation>
  </message>
  <message>
   <source>Door {name}</source>
   <translation>Tür {name}</translation>
  </message>
  <message>
   <source>Door, found shut</source>
   <translation>Tür, geschlossen</translation>
  </message>
  <message>
   <source>Doors</source>
   <translation>Türen</translation>
  </message>
  <message>
   <source>Doors by histogram, smoothed gradient and matched filter.</source>
   <translation>Türen durch Histogramm, geglätteten Gradienten und angepasstes Filter.</translation>
  </message>
  <message>
   <source>Doors that are less probable are not reported.</source>
   <translation>Weniger wahrscheinliche Türen werden nicht gemeldet.</translation>
  </message>
  <message>
   <source>Double click</source>
   <translation>Doppelklick</translation>
  </message>
  <message>
   <source>Drag a selected plane or type its offset; two clicks add one.</source>
   <translation>Eine gewählte Ebene ziehen oder ihre Lage eingeben; zwei Klicks fügen eine hinzu.</translation>
  </message>
  <message>
   <source>Drag a selected wall</source>
   <translation>Eine gewählte Wand ziehen</translation>
  </message>
  <message>
   <source>Drag an end of the door, or type its width.</source>
   <translation>Ein Ende der Tür ziehen oder ihre Breite tippen.</translation>
  </message>
  <message>
   <source>Drag the end of a selected door</source>
   <translation>Das Ende einer gewählten Tür ziehen</translation>
  </message>
  <message>
   <source>Drag the selected plane, or type its offset (@0.05 moves it by that). Two clicks add a plane.</source>
   <translation>Die gewählte Ebene ziehen oder ihre Lage tippen (@0.05 verschiebt um so viel). Zwei Klicks fügen eine hinzu.</translation>
  </message>
  <message>
   <source>Drag the wall, or type its offset (@0.05 moves it by that).</source>
   <translation>Die Wand ziehen oder ihre Lage tippen (@0,05 verschiebt sie um so viel).</translation>
  </message>
  <message>
   <source>Draw a wall that the machine does not know: two clicks.</source>
   <translation>Eine Wand zeichnen, die das Programm nicht kennt: zwei Klicks.</translation>
  </message>
  <message>
   <source>Drift</source>
   <translation>Drift</translation>
  </message>
  <message>
   <source>Drop a survey or a project here</source>
   <translation>Aufnahme oder Projekt hier ablegen</translation>
  </message>
  <message>
   <source>E</source>
   <translation>O</translation>
  </message>
  <message>
   <source>E57: several scans with poses, cartesian or spherical</source>
   <translation>E57: mehrere Scans mit Posen, kartesisch oder sphärisch</translation>
  </message>
  <message>
   <source>Edit</source>
   <translation>Bearbeiten</translation>
  </message>
  <message>
   <source>English</source>
   <translation>English</translation>
  </message>
  <message>
   <source>Error of its heading for each metre.</source>
   <translation>Fehler ihrer Richtung je Meter.</translation>
  </message>
  <message>
   <source>Error of the path for each metre of it.</source>
   <translation>Fehler des Weges je Meter.</translation>
  </message>
  <message>
   <source>Esc</source>
   <translation>Esc</translation>
  </message>
  <message>
   <source>Exact cover</source>
   <translation>Exakte Überdeckung</translation>
  </message>
  <message>
   <source>Export CSV…</source>
   <translation>CSV exportieren…</translation>
  </message>
  <message>
   <source>Export the ground-truth table</source>
   <translation>Die Kontrolltabelle exportieren</translation>
  </message>
  <message>
   <source>Export the ground-truth table…</source>
   <translation>Kontrolltabelle exportieren…</translation>
  </message>
  <message>
   <source>Export the plan</source>
   <translation>Den Plan exportieren</translation>
  </message>
  <message>
   <source>Export the plan: give the path as an argument; a script has nobody to ask.</source>
   <translation>Plan exportieren: den Pfad als Argument angeben; ein Skript kann niemanden fragen.</translation>
  </message>
  <message>
   <source>Exported {0}.</source>
   <translation>{0} exportiert.</translation>
  </message>
  <message>
   <source>Exporting</source>
   <translation>Exportieren</translation>
  </message>
  <message>
   <source>Exporting {0}</source>
   <translation>{0} wird exportiert</translation>
  </message>
  <message>
   <source>Export…</source>
   <translation>Exportieren…</translation>
  </message>
  <message>
   <source>Faces</source>
   <translation>Weist nach</translation>
  </message>
  <message>
   <source>Faces east</source>
   <translation>Weist nach Osten</translation>
  </message>
  <message>
   <source>Faces north</source>
   <translation>Weist nach Norden</translation>
  </message>
  <message>
   <source>Faces south</source>
   <translation>Weist nach Süden</translation>
  </message>
  <message>
   <source>Faces west</source>
   <translation>Weist nach Westen</translation>
  </message>
  <message>
   <source>Facing</source>
   <translation>Richtung</translation>
  </message>
  <message>
   <source>Facings are known once there is a plan: points by height</source>
   <translation>Richtungen gibt es mit dem Plan: Punkte nach Höhe</translation>
  </message>
  <message>
   <source>Feet and inches</source>
   <translation>Fuß und Zoll</translation>
  </message>
  <message>
   <source>Figure (a): layout planes as red (x) and green (y) dotted lines over their observed points.</source>
   <translation>Abbildung (a): Wandebenen als rote (x) und grüne (y) Punktlinien über ihren gesehenen Punkten.</translation>
  </message>
  <message>
   <source>Figure (b): known free white, speculated free grey, the rest black, the plan outlined.</source>
   <translation>Abbildung (b): bekannt Freies weiß, vermutet Freies grau, der Rest schwarz, der Plan umrissen.</translation>
  </message>
  <message>
   <source>Figure (c): rooms cyan, corridors magenta, doors yellow, regions numbered, areas.</source>
   <translation>Abbildung (c): Räume cyan, Flure magenta, Türen gelb, Regionen mit Nummern, Flächen.</translation>
  </message>
  <message>
   <source>File</source>
   <translation>Datei</translation>
  </message>
  <message>
   <source>Files</source>
   <translation>Dateien</translation>
  </message>
  <message>
   <source>Filter</source>
   <translation>Filter</translation>
  </message>
  <message>
   <source>Find a command…</source>
   <translation>Befehl suchen…</translation>
  </message>
  <message>
   <source>Find the simplest building that explains what was seen, and move the path to fit it.</source>
   <translation>Das einfachste Gebäude finden, das alles Gesehene erklärt, und den Weg danach ausrichten.</translation>
  </message>
  <message>
   <source>Find the survey…</source>
   <translation>Aufnahme suchen…</translation>
  </message>
  <message>
   <source>Find {0}</source>
   <translation>{0} suchen</translation>
  </message>
  <message>
   <source>Finding the axes</source>
   <translation>Achsen bestimmen</translation>
  </message>
  <message>
   <source>Finding the storeys</source>
   <translation>Geschosse bestimmen</translation>
  </message>
  <message>
   <source>Fit</source>
   <translation>Einpassen</translation>
  </message>
  <message>
   <source>Floor plan</source>
   <translation>Grundriss</translation>
  </message>
  <message>
   <source>Floor plans with what was not seen, after the paper “{title}” by Shariati, Pfrommer and Taylor.</source>
   <translation>Grundrisse samt dem, was nicht gesehen wurde, nach dem Artikel „{title}“ von Shariati, Pfrommer und Taylor.</translation>
  </message>
  <message>
   <source>Floor to ceiling</source>
   <translation>Vom Boden zur Decke</translation>
  </message>
  <message>
   <source>Floorcast (*{0})</source>
   <translation>Floorcast (*{0})</translation>
  </message>
  <message>
   <source>Floorcast did not end well. {title} was kept as it was at {when}.</source>
   <translation>Floorcast wurde unerwartet beendet. {title} ist auf dem Stand von {when} erhalten.</translation>
  </message>
  <message>
   <source>Floorcast failed in this job ({0}: {1}).</source>
   <translation>Floorcast ist bei dieser Arbeit gescheitert ({0}: {1}).</translation>
  </message>
  <message>
   <source>Folder of numbered scans (000000.ply, .pcd, .bin, .npz, ...) with a trajectory</source>
   <translation>Ordner nummerierter Scans (000000.ply, .pcd, .bin, .npz, ...) mit einer Trajektorie</translation>
  </message>
  <message>
   <source>For as-built drawings; a region needs at least a third of its floor seen, and doubtful doors are left out.</source>
   <translation>Für Bestandspläne: Von einer Region muss mindestens ein Drittel gesehen sein, zweifelhafte Türen entfallen.</translation>
  </message>
  <message>
   <source>For scripts: select things by kind and id.</source>
   <translation>Für Skripte: Dinge nach Art und Kennung wählen.</translation>
  </message>
  <message>
   <source>Force the yaw of the walls instead of estimating it.</source>
   <translation>Die Drehung der Wände vorgeben, statt sie zu schätzen.</translation>
  </message>
  <message>
   <source>Format</source>
   <translation>Format</translation>
  </message>
  <message>
   <source>Four panes side by side.</source>
   <translation>Vier Ansichten nebeneinander.</translation>
  </message>
  <message>
   <source>Frame</source>
   <translation>Achsensystem</translation>
  </message>
  <message>
   <source>Free</source>
   <translation>Frei</translation>
  </message>
  <message>
   <source>Free space</source>
   <translation>Freiraum</translation>
  </message>
  <message>
   <source>Free space appears here once a survey is planned.</source>
   <translation>Hier erscheint der Freiraum nach dem Planen.</translation>
  </message>
  <message>
   <source>Free space ends there along a straight line</source>
   <translation>Der Freiraum endet dort an einer geraden Linie</translation>
  </message>
  <message>
   <source>Free space runs through it</source>
   <translation>Freiraum geht hindurch</translation>
  </message>
  <message>
   <source>Free space that was not seen</source>
   <translation>Freiraum, der nicht gesehen wurde</translation>
  </message>
  <message>
   <source>From</source>
   <translation>Von</translation>
  </message>
  <message>
   <source>From a ceiling to the floor of the storey above it at most.</source>
   <translation>Höchstens von einer Decke zum Boden des Geschosses darüber.</translation>
  </message>
  <message>
   <source>From a floor to the ceiling above it at least.</source>
   <translation>Mindestens von einem Boden zur Decke darüber.</translation>
  </message>
  <message>
   <source>From plan</source>
   <translation>Aus dem Plan</translation>
  </message>
  <message>
   <source>From the floor to the lintel</source>
   <translation>Vom Boden bis zum Sturz</translation>
  </message>
  <message>
   <source>From what was measured to the plan that explains it.</source>
   <translation>Vom Gemessenen zum Plan, der es erklärt.</translation>
  </message>
  <message>
   <source>Front</source>
   <translation>Vorne</translation>
  </message>
  <message>
   <source>Furniture height</source>
   <translation>Möbelhöhe</translation>
  </message>
  <message>
   <source>Furniture ratio</source>
   <translation>Möbelverhältnis</translation>
  </message>
  <message>
   <source>Furniture size</source>
   <translation>Möbelgröße</translation>
  </message>
  <message>
   <source>GPS time</source>
   <translation>GPS-Zeit</translation>
  </message>
  <message>
   <source>Give it the name that people use.</source>
   <translation>Den Namen geben, den die Leute benutzen.</translation>
  </message>
  <message>
   <source>Gradient</source>
   <translation>Gradient</translation>
  </message>
  <message>
   <source>Grid {step}</source>
   <translation>Raster {step}</translation>
  </message>
  <message>
   <source>Ground truth</source>
   <translation>Kontrollmaße</translation>
  </message>
  <message>
   <source>Guessed side</source>
   <translation>Geratene Seite</translation>
  </message>
  <message>
   <source>Guessed sides</source>
   <translation>Geratene Seiten</translation>
  </message>
  <message>
   <source>Half of what is free</source>
   <translation>Hälfte des freien</translation>
  </message>
  <message>
   <source>Halls and long ranges</source>
   <translation>Hallen und große Weiten</translation>
  </message>
  <message>
   <source>Heading</source>
   <translation>Richtung</translation>
  </message>
  <message>
   <source>Height</source>
   <translation>Höhe</translation>
  </message>
  <message>
   <source>Height h above the floor; none: the height that shows most free cells.</source>
   <translation>Höhe h über dem Boden; keine: die Höhe mit den meisten freien Zellen.</translation>
  </message>
  <message>
   <source>Height of the slice above the floor</source>
   <translation>Höhe des Schnitts über dem Boden</translation>
  </message>
  <message>
   <source>Help</source>
   <translation>Hilfe</translation>
  </message>
  <message>
   <source>Hide</source>
   <translation>Ausblenden</translation>
  </message>
  <message>
   <source>Hide it in the panes</source>
   <translation>In den Ansichten ausblenden</translation>
  </message>
  <message>
   <source>Histogram</source>
   <translation>Histogramm</translation>
  </message>
  <message>
   <source>Histogram, gradient and matched filter along the wall</source>
   <translation>Histogramm, Gradient und angepasstes Filter entlang der Wand</translation>
  </message>
  <message>
   <source>History</source>
   <translation>Verlauf</translation>
  </message>
  <message>
   <source>History…</source>
   <translation>Verlauf…</translation>
  </message>
  <message>
   <source>Hit ratio</source>
   <translation>Trefferanteil</translation>
  </message>
  <message>
   <source>How many are offered again; 0 remembers none.</source>
   <translation>Wie viele wieder angeboten werden; 0 merkt sich keine.</translation>
  </message>
  <message>
   <source>How often the view is kept for the case of a crash; every edit is kept at once.</source>
   <translation>Wie oft die Ansicht für den Fall eines Absturzes gesichert wird; jede Änderung wird es sofort.</translation>
  </message>
  <message>
   <source>How sure</source>
   <translation>Wie sicher</translation>
  </message>
  <message>
   <source>How the file is read.</source>
   <translation>Wie die Datei gelesen wird.</translation>
  </message>
  <message>
   <source>In stations, shops and plants walls are far and doors are wide; points are kept to 100 m.</source>
   <translation>In Bahnhöfen, Läden und Werken sind Wände fern und Türen breit; Punkte gelten bis 100 m.</translation>
  </message>
  <message>
   <source>In the wing: {0}</source>
   <translation>Im Gebäudeflügel: {0}</translation>
  </message>
  <message>
   <source>In use</source>
   <translation>In Gebrauch</translation>
  </message>
  <message>
   <source>Indoor share</source>
   <translation>Innenanteil</translation>
  </message>
  <message>
   <source>Input</source>
   <translation>Eingabe</translation>
  </message>
  <message>
   <source>Inspect</source>
   <translation>Prüfen</translation>
  </message>
  <message>
   <source>Intensity</source>
   <translation>Intensität</translation>
  </message>
  <message>
   <source>Interrupted; nothing was written.</source>
   <translation>Unterbrochen; nichts wurde geschrieben.</translation>
  </message>
  <message>
   <source>Isolated objects longer than this times their width are pieces of wall.</source>
   <translation>Freistehende Objekte, die länger als das Soundsovielfache ihrer Breite sind, sind Wandstücke.</translation>
  </message>
  <message>
   <source>It is a door, however sure the machine is.</source>
   <translation>Es ist eine Tür, wie sicher das Programm auch ist.</translation>
  </message>
  <message>
   <source>It is a wall, even where the machine takes it for furniture; also switches a wall on again.</source>
   <translation>Es ist eine Wand, auch wo das Programm sie für ein Möbel hält; schaltet eine Wand auch wieder ein.</translation>
  </message>
  <message>
   <source>It is long, and its top was not seen</source>
   <translation>Sie ist lang, ihr oberes Ende wurde nicht gesehen</translation>
  </message>
  <message>
   <source>It is low</source>
   <translation>Sie ist niedrig</translation>
  </message>
  <message>
   <source>It is narrow between two wide spaces</source>
   <translation>Es ist eng zwischen zwei weiten Räumen</translation>
  </message>
  <message>
   <source>It is no door: the wall goes on here.</source>
   <translation>Es ist keine Tür: Die Wand geht hier weiter.</translation>
  </message>
  <message>
   <source>It is no wall: it bounds no room and keeps none apart.</source>
   <translation>Es ist keine Wand: Sie begrenzt und trennt keinen Raum.</translation>
  </message>
  <message>
   <source>It is the other face of a wall</source>
   <translation>Sie ist die andere Seite einer Wand</translation>
  </message>
  <message>
   <source>It lies in line with a wall</source>
   <translation>Sie liegt in einer Linie mit einer Wand</translation>
  </message>
  <message>
   <source>It reaches above furniture</source>
   <translation>Sie reicht höher als Möbel</translation>
  </message>
  <message>
   <source>It reaches the ceiling</source>
   <translation>Sie reicht bis zur Decke</translation>
  </message>
  <message>
   <source>It was seen from both sides of the wall</source>
   <translation>Sie wurde von beiden Seiten der Wand gesehen</translation>
  </message>
  <message>
   <source>Its leaf stands back from the wall</source>
   <translation>Ihr Türblatt liegt hinter der Wandfläche</translation>
  </message>
  <message>
   <source>Its poses reflect the sensor's axes; the file is taken as right-handed, as asked.</source>
   <translation>Ihre Posen spiegeln die Achsen des Sensors; die Datei gilt wie verlangt als rechtshändig.</translation>
  </message>
  <message>
   <source>Its thickness</source>
   <translation>Ihre Dicke</translation>
  </message>
  <message>
   <source>Join gap</source>
   <translation>Verbindungslücke</translation>
  </message>
  <message>
   <source>Joins</source>
   <translation>Verbindet</translation>
  </message>
  <message>
   <source>Keep it whatever the machine finds</source>
   <translation>Behalten, was das Programm auch findet</translation>
  </message>
  <message>
   <source>Keep wall</source>
   <translation>Wand behalten</translation>
  </message>
  <message>
   <source>Keep {0}</source>
   <translation>{0} behalten</translation>
  </message>
  <message>
   <source>Kept by hand</source>
   <translation>Von Hand behalten</translation>
  </message>
  <message>
   <source>Kept whatever the machine finds</source>
   <translation>Wird behalten, was das Programm auch findet</translation>
  </message>
  <message>
   <source>Keyframe</source>
   <translation>Keyframe</translation>
  </message>
  <message>
   <source>Kind</source>
   <translation>Art</translation>
  </message>
  <message>
   <source>LAS and LAZ</source>
   <translation>LAS und LAZ</translation>
  </message>
  <message>
   <source>LAS and LAZ 1.0 to 1.4, with GPS time, classes and CRS</source>
   <translation>LAS und LAZ 1.0 bis 1.4, mit GPS-Zeit, Klassen und Koordinatensystem</translation>
  </message>
  <message>
   <source>LAS file</source>
   <translation>LAS-Datei</translation>
  </message>
  <message>
   <source>LOA</source>
   <translation>LOA</translation>
  </message>
  <message>
   <source>Label {0} as {1}</source>
   <translation>{0} als {1} bezeichnen</translation>
  </message>
  <message>
   <source>Labelled by hand</source>
   <translation>Von Hand bezeichnet</translation>
  </message>
  <message>
   <source>Labels</source>
   <translation>Bezeichnungen</translation>
  </message>
  <message>
   <source>Language</source>
   <translation>Sprache</translation>
  </message>
  <message>
   <source>Language, theme, units, autosave, recent files and memory.</source>
   <translation>Sprache, Farben, Einheiten, Sichern, letzte Dateien und Speicher.</translation>
  </message>
  <message>
   <source>Large screen</source>
   <translation>Großer Bildschirm</translation>
  </message>
  <message>
   <source>Largest angle of a surface to the axis of its facing.</source>
   <translation>Größter Winkel einer Fläche zur Achse ihrer Richtung.</translation>
  </message>
  <message>
   <source>Largest ratio of a cell's thickness to its width.</source>
   <translation>Größtes Verhältnis von Dicke zu Breite einer Zelle.</translation>
  </message>
  <message>
   <source>Largest ratio of a door's width to the free width beyond, on both sides.</source>
   <translation>Größtes Verhältnis der Türbreite zur freien Breite dahinter, auf beiden Seiten.</translation>
  </message>
  <message>
   <source>Largest ratio of half a corridor's width to the hall's inscribed radius.</source>
   <translation>Größtes Verhältnis der halben Flurbreite zum Inkreisradius der Halle.</translation>
  </message>
  <message>
   <source>Laser meter</source>
   <translation>Lasermessgerät</translation>
  </message>
  <message>
   <source>Lay the voxels along the survey's own axes: where the file's world lies changes nothing.</source>
   <translation>Die Voxel längs der Achsen der Aufnahme legen: Wo die Welt der Datei liegt, ändert nichts.</translation>
  </message>
  <message>
   <source>Layers</source>
   <translation>Layer</translation>
  </message>
  <message>
   <source>Layout planes</source>
   <translation>Wandebenen</translation>
  </message>
  <message>
   <source>Layout planes appear here once a survey is planned.</source>
   <translation>Hier erscheinen die Wandebenen nach dem Planen.</translation>
  </message>
  <message>
   <source>Layout segments</source>
   <translation>Wandstücke</translation>
  </message>
  <message>
   <source>Layout segments: observed patches of structural surfaces.</source>
   <translation>Wandstücke: gesehene Flecken baulicher Flächen.</translation>
  </message>
  <message>
   <source>Least share of a space that its rectangles must explain; else the map's outline is taken.</source>
   <translation>Mindestanteil eines Raums, den seine Rechtecke erklären müssen; sonst gilt der Umriss der Karte.</translation>
  </message>
  <message>
   <source>Least share of wall in the line of a door, the door included.</source>
   <translation>Mindestanteil an Wand in der Linie einer Tür, die Tür eingeschlossen.</translation>
  </message>
  <message>
   <source>Left drag in 3D</source>
   <translation>Ziehen mit links in 3D</translation>
  </message>
  <message>
   <source>Leg size</source>
   <translation>Beingröße</translation>
  </message>
  <message>
   <source>Legend</source>
   <translation>Legende</translation>
  </message>
  <message>
   <source>Length</source>
   <translation>Länge</translation>
  </message>
  <message>
   <source>Length that is wall: seen, or between seen parts</source>
   <translation>Länge, die Wand ist: gesehen oder zwischen gesehenen Teilen</translation>
  </message>
  <message>
   <source>Lengths</source>
   <translation>Längen</translation>
  </message>
  <message>
   <source>Lengths, areas and words as the drawing writes them.</source>
   <translation>Längen, Flächen und Wörter, wie die Zeichnung sie schreibt.</translation>
  </message>
  <message>
   <source>Lengths, differences, percentages, means and accuracy bands as CSV.</source>
   <translation>Längen, Unterschiede, Prozente, Mittel und Genauigkeitsklassen als CSV.</translation>
  </message>
  <message>
   <source>Level of accuracy (USIBD) that the difference meets</source>
   <translation>Genauigkeitsklasse (USIBD), die der Unterschied erfüllt</translation>
  </message>
  <message>
   <source>Level of accuracy (USIBD) that the residual meets</source>
   <translation>Genauigkeitsklasse (USIBD), die die Restabweichung erfüllt</translation>
  </message>
  <message>
   <source>Libraries of the program cannot be unpacked into {0}: {1}; free 400 MB there, or set XDG_CACHE_HOME to a folder with room.</source>
   <translation>Bibliotheken des Programms lassen sich nicht nach {0} entpacken: {1}; dort 400 MB frei machen oder XDG_CACHE_HOME auf einen Ordner mit Platz setzen.</translation>
  </message>
  <message>
   <source>Licence</source>
   <translation>Lizenz</translation>
  </message>
  <message>
   <source>Light</source>
   <translation>Hell</translation>
  </message>
  <message>
   <source>Line {0} of depth.txt is not a time and the name of an image.</source>
   <translation>Zeile {0} von depth.txt ist nicht eine Zeit und der Name eines Bildes.</translation>
  </message>
  <message>
   <source>Line {0} of the trajectory {1}</source>
   <translation>Zeile {0} der Trajektorie {1}</translation>
  </message>
  <message>
   <source>Line {0} of the trajectory {1} has {2} columns, those before {3}.</source>
   <translation>Zeile {0} der Trajektorie {1} hat {2} Spalten, die davor {3}.</translation>
  </message>
  <message>
   <source>Line {0} of the trajectory {1} holds no pose of finite numbers.</source>
   <translation>Zeile {0} der Trajektorie {1} enthält keine Pose aus endlichen Zahlen.</translation>
  </message>
  <message>
   <source>Line {0} of the trajectory {1} is no rotation with a translation.</source>
   <translation>Zeile {0} der Trajektorie {1} ist keine Drehung mit einer Verschiebung.</translation>
  </message>
  <message>
   <source>Line {0} of the trajectory {1} is not a row of numbers: {2}.</source>
   <translation>Zeile {0} der Trajektorie {1} ist keine Zeile von Zahlen: {2}.</translation>
  </message>
  <message>
   <source>Lintel depth</source>
   <translation>Sturztiefe</translation>
  </message>
  <message>
   <source>Longest run of the exact solver.</source>
   <translation>Längste Laufzeit des exakten Lösers.</translation>
  </message>
  <message>
   <source>Look from a corner, from above</source>
   <translation>Von einer Ecke schräg von oben</translation>
  </message>
  <message>
   <source>Look from there, key {key}</source>
   <translation>Von dort schauen, Taste {key}</translation>
  </message>
  <message>
   <source>Looks right</source>
   <translation>Stimmt so</translation>
  </message>
  <message>
   <source>Machine had said</source>
   <translation>Vom Programm</translation>
  </message>
  <message>
   <source>Made from</source>
   <translation>Gemacht aus</translation>
  </message>
  <message>
   <source>Made with</source>
   <translation>Gemacht mit</translation>
  </message>
  <message>
   <source>Make the selected regions one; the wall between them goes.</source>
   <translation>Die gewählten Regionen vereinen; die Wand dazwischen fällt weg.</translation>
  </message>
  <message>
   <source>Manhattan frame: gravity and yaw.</source>
   <translation>Manhattan-Achsensystem: Lot und Drehung.</translation>
  </message>
  <message>
   <source>Maps</source>
   <translation>Karten</translation>
  </message>
  <message>
   <source>Max askew</source>
   <translation>Schräganteil höchstens</translation>
  </message>
  <message>
   <source>Max beamless</source>
   <translation>Breite ohne Unterzug höchstens</translation>
  </message>
  <message>
   <source>Max count</source>
   <translation>Anzahl höchstens</translation>
  </message>
  <message>
   <source>Max door</source>
   <translation>Türbreite höchstens</translation>
  </message>
  <message>
   <source>Max mouth</source>
   <translation>Mündung höchstens</translation>
  </message>
  <message>
   <source>Max opening</source>
   <translation>Öffnung höchstens</translation>
  </message>
  <message>
   <source>Max passage</source>
   <translation>Durchgang höchstens</translation>
  </message>
  <message>
   <source>Max range</source>
   <translation>Entfernung höchstens</translation>
  </message>
  <message>
   <source>Max ratio</source>
   <translation>Verhältnis höchstens</translation>
  </message>
  <message>
   <source>Max room perimeter</source>
   <translation>Raumumfang höchstens</translation>
  </message>
  <message>
   <source>Max room turning</source>
   <translation>Drehabstand von Räumen höchstens</translation>
  </message>
  <message>
   <source>Max slab</source>
   <translation>Deckenstärke höchstens</translation>
  </message>
  <message>
   <source>Max thickness</source>
   <translation>Dicke höchstens</translation>
  </message>
  <message>
   <source>Max width</source>
   <translation>Breite höchstens</translation>
  </message>
  <message>
   <source>Mean of {n}: {error} · {percent} %</source>
   <translation>Mittel aus {n}: {error} · {percent} %</translation>
  </message>
  <message>
   <source>Measure</source>
   <translation>Messen</translation>
  </message>
  <message>
   <source>Measure a distance on the plan; then type here what the laser meter said.</source>
   <translation>Einen Abstand im Plan messen; dann hier eingeben, was das Lasermessgerät sagte.</translation>
  </message>
  <message>
   <source>Measure {0} m</source>
   <translation>{0} m messen</translation>
  </message>
  <message>
   <source>Memory</source>
   <translation>Speicher</translation>
  </message>
  <message>
   <source>Merge</source>
   <translation>Vereinen</translation>
  </message>
  <message>
   <source>Merge regions</source>
   <translation>Regionen vereinen</translation>
  </message>
  <message>
   <source>Merge {0}</source>
   <translation>{0} vereinen</translation>
  </message>
  <message>
   <source>Merged by hand</source>
   <translation>Von Hand vereint</translation>
  </message>
  <message>
   <source>Meshes: PLY with faces, OBJ, STL, GLB and glTF, OFF</source>
   <translation>Netze: PLY mit Flächen, OBJ, STL, GLB und glTF, OFF</translation>
  </message>
  <message>
   <source>Metres</source>
   <translation>Meter</translation>
  </message>
  <message>
   <source>Middle or right drag</source>
   <translation>Ziehen mit der mittleren oder rechten Taste</translation>
  </message>
  <message>
   <source>Min area</source>
   <translation>Fläche mindestens</translation>
  </message>
  <message>
   <source>Min component</source>
   <translation>Fleck mindestens</translation>
  </message>
  <message>
   <source>Min confidence</source>
   <translation>Sicherheit mindestens</translation>
  </message>
  <message>
   <source>Min height</source>
   <translation>Höhe mindestens</translation>
  </message>
  <message>
   <source>Min length</source>
   <translation>Länge mindestens</translation>
  </message>
  <message>
   <source>Min misses</source>
   <translation>Durchgänge mindestens</translation>
  </message>
  <message>
   <source>Min range</source>
   <translation>Entfernung mindestens</translation>
  </message>
  <message>
   <source>Min response</source>
   <translation>Antwort mindestens</translation>
  </message>
  <message>
   <source>Min rest side</source>
   <translation>Restseite mindestens</translation>
  </message>
  <message>
   <source>Min share</source>
   <translation>Anteil mindestens</translation>
  </message>
  <message>
   <source>Min side</source>
   <translation>Seite mindestens</translation>
  </message>
  <message>
   <source>Min space</source>
   <translation>Raum mindestens</translation>
  </message>
  <message>
   <source>Min support</source>
   <translation>Stützung mindestens</translation>
  </message>
  <message>
   <source>Min width</source>
   <translation>Breite mindestens</translation>
  </message>
  <message>
   <source>Mirrored</source>
   <translation>Gespiegelt</translation>
  </message>
  <message>
   <source>More valid rectangles than this on 20,000 m2 are refused; a larger site may have as many more.</source>
   <translation>Mehr gültige Rechtecke auf 20.000 m² werden abgelehnt; ein größeres Gelände darf entsprechend mehr haben.</translation>
  </message>
  <message>
   <source>Mouse</source>
   <translation>Maus</translation>
  </message>
  <message>
   <source>Mouth opening</source>
   <translation>Mündungsverengung</translation>
  </message>
  <message>
   <source>Move it; it snaps to evidence</source>
   <translation>Verschiebt sie; sie rastet an Gemessenem ein</translation>
  </message>
  <message>
   <source>Move wall {0} to {1} m</source>
   <translation>Wand {0} nach {1} m schieben</translation>
  </message>
  <message>
   <source>Move wall…</source>
   <translation>Wand verschieben…</translation>
  </message>
  <message>
   <source>Moved by hand</source>
   <translation>Von Hand verschoben</translation>
  </message>
  <message>
   <source>N</source>
   <translation>N</translation>
  </message>
  <message>
   <source>Name</source>
   <translation>Name</translation>
  </message>
  <message>
   <source>Name of the region classifier (see `floorcast plugins`).</source>
   <translation>Name des Klassifikators der Regionen (siehe `floorcast plugins`).</translation>
  </message>
  <message>
   <source>Named by hand</source>
   <translation>Von Hand benannt</translation>
  </message>
  <message>
   <source>Narrower gaps are holes in the data.</source>
   <translation>Schmalere Lücken sind Löcher in den Daten.</translation>
  </message>
  <message>
   <source>Narrower openings are no doors (paper: 0.8 m).</source>
   <translation>Schmalere Öffnungen sind keine Türen (Artikel: 0,8 m).</translation>
  </message>
  <message>
   <source>New</source>
   <translation>Neu</translation>
  </message>
  <message>
   <source>No depth image from {0} on holds a depth of up to {1} m.</source>
   <translation>Ab {0} enthält kein Tiefenbild eine Tiefe bis {1} m.</translation>
  </message>
  <message>
   <source>No file fits the pattern {0}.</source>
   <translation>Keine Datei passt auf das Muster {0}.</translation>
  </message>
  <message>
   <source>No file states the intrinsics: those of a PrimeSense camera are assumed.</source>
   <translation>Keine Datei nennt die Kameradaten: Die einer PrimeSense-Kamera werden angenommen.</translation>
  </message>
  <message>
   <source>No free space was seen indoors at {0} m above the floor; set occupancy.slice_height to a height that the sensor saw through, or give the trajectory (--trajectory).</source>
   <translation>In {0} m Höhe über dem Boden wurde im Haus kein freier Raum gesehen; occupancy.slice_height auf eine Höhe setzen, durch die der Sensor sah, oder die Trajektorie angeben (--trajectory).</translation>
  </message>
  <message>
   <source>No input was named.</source>
   <translation>Keine Eingabe wurde genannt.</translation>
  </message>
  <message>
   <source>No plan could be made</source>
   <translation>Kein Plan möglich</translation>
  </message>
  <message>
   <source>No plan yet.</source>
   <translation>Noch kein Plan.</translation>
  </message>
  <message>
   <source>No point of {0} refers to its trajectory; drift cannot be corrected.</source>
   <translation>Kein Punkt von {0} bezieht sich auf seine Trajektorie; die Drift lässt sich nicht korrigieren.</translation>
  </message>
  <message>
   <source>No region came out of {0}: no enclosed free space is larger than {1} m2; check the resolution and the thresholds of the map.</source>
   <translation>Keine Region kam aus {0} heraus: Kein umschlossener freier Raum ist größer als {1} m2; Auflösung und Schwellen der Karte prüfen.</translation>
  </message>
  <message>
   <source>No region came out: the free space seen is not enclosed by any pair of walls; scan more walls, or raise candidates.max_ratio.</source>
   <translation>Keine Region kam heraus: Kein Paar von Wänden schließt den gesehenen freien Raum ein; mehr Wände scannen oder candidates.max_ratio erhöhen.</translation>
  </message>
  <message>
   <source>No setting is called that.</source>
   <translation>So heißt keine Einstellung.</translation>
  </message>
  <message>
   <source>No such file or directory</source>
   <translation>Datei oder Ordner fehlt</translation>
  </message>
  <message>
   <source>No trajectory was found beside {0}: sensor positions are not known.</source>
   <translation>Neben {0} wurde keine Trajektorie gefunden: Die Lagen des Sensors sind nicht bekannt.</translation>
  </message>
  <message>
   <source>No wall was recognised: every vertical surface ends below furniture height (segments.furniture_height) or is too small; scan higher, or lower that setting.</source>
   <translation>Keine Wand wurde erkannt: Jede senkrechte Fläche endet unter der Möbelhöhe (segments.furniture_height) oder ist zu klein; höher scannen oder diese Einstellung senken.</translation>
  </message>
  <message>
   <source>No walls were found: only {0} m2 of vertical surface among {1} occupied voxels</source>
   <translation>Keine Wände wurden gefunden: nur {0} m2 senkrechter Fläche unter {1} belegten Voxeln</translation>
  </message>
  <message>
   <source>No whole scan with a pose came into {0} in time; scans are numbered files (000000.ply, …), and each needs its row of the trajectory.</source>
   <translation>Kein vollständiger Scan mit einer Pose kam rechtzeitig nach {0}; Scans sind nummerierte Dateien (000000.ply, …), und jeder braucht seine Zeile der Trajektorie.</translation>
  </message>
  <message>
   <source>None of the scans {0} to {1} holds a point.</source>
   <translation>Keiner der Scans {0} bis {1} enthält einen Punkt.</translation>
  </message>
  <message>
   <source>None of the {0} depth images of {1} has a usable pose.</source>
   <translation>Keines der {0} Tiefenbilder von {1} hat eine brauchbare Pose.</translation>
  </message>
  <message>
   <source>None of the {0} scans of {1} can be read; the log is damaged.</source>
   <translation>Keiner der {0} Scans von {1} lässt sich lesen; das Protokoll ist beschädigt.</translation>
  </message>
  <message>
   <source>Not enough memory for this survey.</source>
   <translation>Zu wenig Speicher für diese Aufnahme.</translation>
  </message>
  <message>
   <source>Not read: {0}; --set input.topic=NAME,NAME reads the topics that it names.</source>
   <translation>Nicht gelesen: {0}; --set input.topic=NAME,NAME liest die genannten Topics.</translation>
  </message>
  <message>
   <source>Not seen</source>
   <translation>Nicht gesehen</translation>
  </message>
  <message>
   <source>Note</source>
   <translation>Notiz</translation>
  </message>
  <message>
   <source>Note on {0}</source>
   <translation>Notiz zu {0}</translation>
  </message>
  <message>
   <source>Nothing can be clicked by coordinates in the pane {0}.</source>
   <translation>In der Ansicht {0} lässt sich nichts nach Koordinaten anklicken.</translation>
  </message>
  <message>
   <source>Nothing stands in it</source>
   <translation>Nichts steht darin</translation>
  </message>
  <message>
   <source>Nothing to warn of.</source>
   <translation>Nichts zu warnen.</translation>
  </message>
  <message>
   <source>Nothing was said by hand of {0}.</source>
   <translation>Von Hand wurde über {0} nichts gesagt.</translation>
  </message>
  <message>
   <source>Nothing was seen along this wall.</source>
   <translation>Entlang dieser Wand wurde nichts gesehen.</translation>
  </message>
  <message>
   <source>Observed</source>
   <translation>Gesehen</translation>
  </message>
  <message>
   <source>Observed segments</source>
   <translation>Gesehene Wandstücke</translation>
  </message>
  <message>
   <source>Occupancy</source>
   <translation>Belegung</translation>
  </message>
  <message>
   <source>Occupancy grid maps: what parts two rooms on a map without heights.</source>
   <translation>Belegungskarten: was zwei Räume auf einer Karte ohne Höhen trennt.</translation>
  </message>
  <message>
   <source>Occupied</source>
   <translation>Belegt</translation>
  </message>
  <message>
   <source>OctoMap .bt and .ot: occupied and free voxels</source>
   <translation>OctoMap .bt und .ot: belegte und freie Voxel</translation>
  </message>
  <message>
   <source>Odometry</source>
   <translation>Odometrie</translation>
  </message>
  <message>
   <source>Of a wing that stands at this angle to the plan: its offset and the way it faces are along the wing's own axes.</source>
   <translation>Gehört zu einem Flügel, der in diesem Winkel zum Plan steht: Lage und Richtung gelten in dessen eigenen Achsen.</translation>
  </message>
  <message>
   <source>Of all regions, to the inside faces of the walls</source>
   <translation>Aller Regionen, bis zu den Innenseiten der Wände</translation>
  </message>
  <message>
   <source>Of its offset</source>
   <translation>Ihrer Lage</translation>
  </message>
  <message>
   <source>Of lengths and areas wherever they are shown; files have metres.</source>
   <translation>Von Längen und Flächen, wo immer sie stehen; Dateien haben Meter.</translation>
  </message>
  <message>
   <source>Of the largest floor or ceiling: a smaller one parts no storeys (a gallery).</source>
   <translation>Des größten Bodens oder der größten Decke: Kleinere trennen keine Geschosse (eine Galerie).</translation>
  </message>
  <message>
   <source>Of the measured length</source>
   <translation>Der gemessenen Länge</translation>
  </message>
  <message>
   <source>Of the window; an exported drawing has its own.</source>
   <translation>Des Fensters; eine exportierte Zeichnung hat ihre eigene.</translation>
  </message>
  <message>
   <source>Of the window; exported drawings stay light.</source>
   <translation>Des Fensters; exportierte Zeichnungen bleiben hell.</translation>
  </message>
  <message>
   <source>Offset</source>
   <translation>Lage</translation>
  </message>
  <message>
   <source>Offset tolerance</source>
   <translation>Lagetoleranz</translation>
  </message>
  <message>
   <source>One pose for each of the {0} scans so far is needed (given {1}).</source>
   <translation>Für jeden der bisher {0} Scans wird eine Pose gebraucht (angegeben: {1}).</translation>
  </message>
  <message>
   <source>Only what was seen</source>
   <translation>Nur was gesehen wurde</translation>
  </message>
  <message>
   <source>Only {0} of the wall surface fits the two directions of the plan: round walls and walls at other angles come out as steps or are missing (thick noise lowers the share, too); compare the planes with the plan, and force another direction with --set frame.yaw_deg=... if it is wrong.</source>
   <translation>Nur {0} der Wandfläche passen zu den beiden Richtungen des Plans: Runde Wände und solche in anderen Winkeln kommen als Stufen heraus oder fehlen (starkes Rauschen senkt den Anteil ebenfalls); bitte die Ebenen mit dem Plan vergleichen und mit --set frame.yaw_deg=... eine andere Richtung erzwingen, wenn sie falsch ist.</translation>
  </message>
  <message>
   <source>Only {0} of the walls lie along two perpendicular directions; this is hardly a Manhattan world.</source>
   <translation>Nur {0} der Wände liegen entlang zweier senkrechter Richtungen; das ist kaum eine Manhattan-Welt.</translation>
  </message>
  <message>
   <source>Open a folder of scans</source>
   <translation>Einen Ordner mit Scans öffnen</translation>
  </message>
  <message>
   <source>Open a folder of scans.</source>
   <translation>Einen Ordner mit Scans öffnen.</translation>
  </message>
  <message>
   <source>Open a point cloud, mesh, run, grid map or project.</source>
   <translation>Punktwolke, Netz, Fahrt, Rasterkarte oder Projekt öffnen.</translation>
  </message>
  <message>
   <source>Open a survey or project</source>
   <translation>Aufnahme oder Projekt öffnen</translation>
  </message>
  <message>
   <source>Open a survey to see its points here</source>
   <translation>Eine Aufnahme öffnen, um hier ihre Punkte zu sehen</translation>
  </message>
  <message>
   <source>Open folder…</source>
   <translation>Ordner öffnen…</translation>
  </message>
  <message>
   <source>Open in Open3D</source>
   <translation>In Open3D öffnen</translation>
  </message>
  <message>
   <source>Open recent</source>
   <translation>Zuletzt geöffnet</translation>
  </message>
  <message>
   <source>Open the bundled survey</source>
   <translation>Mitgelieferte Aufnahme öffnen</translation>
  </message>
  <message>
   <source>Open {0}</source>
   <translation>{0} öffnen</translation>
  </message>
  <message>
   <source>Open3D's viewer needs a display with OpenGL, and there is none here; the 3D pane shows the same.</source>
   <translation>Open3Ds Anzeige braucht einen Bildschirm mit OpenGL, und hier ist keiner; die 3D-Ansicht zeigt dasselbe.</translation>
  </message>
  <message>
   <source>Opening</source>
   <translation>Durchgang</translation>
  </message>
  <message>
   <source>Opening {name}</source>
   <translation>Öffnung {name}</translation>
  </message>
  <message>
   <source>Open…</source>
   <translation>Öffnen…</translation>
  </message>
  <message>
   <source>Orbit</source>
   <translation>Umkreisen</translation>
  </message>
  <message>
   <source>Other face</source>
   <translation>Andere Seite</translation>
  </message>
  <message>
   <source>Own axes</source>
   <translation>Eigene Achsen</translation>
  </message>
  <message>
   <source>Own colour</source>
   <translation>Eigene Farbe</translation>
  </message>
  <message>
   <source>Own size</source>
   <translation>Eigene Größe</translation>
  </message>
  <message>
   <source>PTX text: scans with their poses, directions without an echo left out</source>
   <translation>PTX-Text: Scans mit ihren Posen, Richtungen ohne Echo weggelassen</translation>
  </message>
  <message>
   <source>Package</source>
   <translation>Paket</translation>
  </message>
  <message>
   <source>Page</source>
   <translation>Seite</translation>
  </message>
  <message>
   <source>Pan</source>
   <translation>Verschieben</translation>
  </message>
  <message>
   <source>Pane</source>
   <translation>Ansicht</translation>
  </message>
  <message>
   <source>Panes</source>
   <translation>Ansichten</translation>
  </message>
  <message>
   <source>Parts</source>
   <translation>Teile</translation>
  </message>
  <message>
   <source>Parts narrower than this are not part of a region.</source>
   <translation>Schmalere Teile gehören zu keiner Region.</translation>
  </message>
  <message>
   <source>Passage opening</source>
   <translation>Durchgangsverengung</translation>
  </message>
  <message>
   <source>Passage wall</source>
   <translation>Wandanteil an Durchgängen</translation>
  </message>
  <message>
   <source>Patches of one segment differ less in their offset.</source>
   <translation>Flecken eines Wandstücks unterscheiden sich weniger in ihrer Lage.</translation>
  </message>
  <message>
   <source>Patches of one surface nearer than this along it are one segment.</source>
   <translation>Flecken einer Fläche, die näher beieinander liegen, sind ein Wandstück.</translation>
  </message>
  <message>
   <source>Path of a keyframe; drift within it is nothing.</source>
   <translation>Weg eines Keyframes; die Drift darin ist unerheblich.</translation>
  </message>
  <message>
   <source>Perimeter</source>
   <translation>Umfang</translation>
  </message>
  <message>
   <source>Permission denied</source>
   <translation>Zugriff verweigert</translation>
  </message>
  <message>
   <source>Picture of a pane</source>
   <translation>Bild einer Ansicht</translation>
  </message>
  <message>
   <source>Picture of a pane…</source>
   <translation>Bild einer Ansicht…</translation>
  </message>
  <message>
   <source>Pictures are written as .png, .jpg or .webp (asked: {0}).</source>
   <translation>Bilder werden als .png, .jpg oder .webp geschrieben (verlangt: {0}).</translation>
  </message>
  <message>
   <source>Plan</source>
   <translation>Plan</translation>
  </message>
  <message>
   <source>Plan a wing that stands at another angle in a frame of its own.</source>
   <translation>Einen Flügel, der in einem anderen Winkel steht, in einem eigenen Achsensystem planen.</translation>
  </message>
  <message>
   <source>Plan again</source>
   <translation>Neu planen</translation>
  </message>
  <message>
   <source>Plan another storey of the survey; each keeps its own corrections and checks.</source>
   <translation>Ein anderes Geschoss der Aufnahme planen; jedes behält seine eigenen Korrekturen und Kontrollmaße.</translation>
  </message>
  <message>
   <source>Plan less laser meter</source>
   <translation>Plan minus Lasermessgerät</translation>
  </message>
  <message>
   <source>Plan the storey above the one that is shown.</source>
   <translation>Das Geschoss über dem gezeigten planen.</translation>
  </message>
  <message>
   <source>Plan the storey below the one that is shown.</source>
   <translation>Das Geschoss unter dem gezeigten planen.</translation>
  </message>
  <message>
   <source>Planarity</source>
   <translation>Ebenheit</translation>
  </message>
  <message>
   <source>Plane</source>
   <translation>Ebene</translation>
  </message>
  <message>
   <source>Plane {id} faces {facing}</source>
   <translation>Ebene {id} weist nach {facing}</translation>
  </message>
  <message>
   <source>Planes</source>
   <translation>Ebenen</translation>
  </message>
  <message>
   <source>Planes are known once there is a plan: points by height</source>
   <translation>Ebenen gibt es mit dem Plan: Punkte nach Höhe</translation>
  </message>
  <message>
   <source>Planes of less observed surface are not paired.</source>
   <translation>Ebenen mit weniger gesehener Fläche werden nicht gepaart.</translation>
  </message>
  <message>
   <source>Planes that face {facing}</source>
   <translation>Ebenen, die nach {facing} weisen</translation>
  </message>
  <message>
   <source>Planning</source>
   <translation>Planen</translation>
  </message>
  <message>
   <source>Play the run</source>
   <translation>Die Fahrt abspielen</translation>
  </message>
  <message>
   <source>Point Cloud Library: ASCII, binary or compressed</source>
   <translation>Point Cloud Library: Text, binär oder komprimiert</translation>
  </message>
  <message>
   <source>Point clouds, meshes, runs of a robot and occupancy maps</source>
   <translation>Punktwolken, Netze, Fahrten eines Roboters und Belegungskarten</translation>
  </message>
  <message>
   <source>Points</source>
   <translation>Punkte</translation>
  </message>
  <message>
   <source>Points above are left out of the histogram (paper: 2 m).</source>
   <translation>Punkte darüber fehlen im Histogramm (Artikel: 2 m).</translation>
  </message>
  <message>
   <source>Points above this height are not drawn in 3D</source>
   <translation>Punkte über dieser Höhe werden in 3D nicht gezeichnet</translation>
  </message>
  <message>
   <source>Points appear here as they are read</source>
   <translation>Die Punkte erscheinen hier, während sie gelesen werden</translation>
  </message>
  <message>
   <source>Points are in the frame {0}; where they were seen from is not recorded.</source>
   <translation>Die Punkte sind im System {0}; von wo sie gesehen wurden, ist nicht aufgezeichnet.</translation>
  </message>
  <message>
   <source>Points are joined to the trajectory by time, at most {0} s apart.</source>
   <translation>Die Punkte werden der Trajektorie über die Zeit zugeordnet, höchstens {0} s auseinander.</translation>
  </message>
  <message>
   <source>Points are not coloured by {0}; choose: {1}.</source>
   <translation>Punkte werden nicht nach {0} gefärbt; zur Wahl stehen: {1}.</translation>
  </message>
  <message>
   <source>Points by colour</source>
   <translation>Punkte färben</translation>
  </message>
  <message>
   <source>Points by facing</source>
   <translation>Punkte nach Richtung</translation>
  </message>
  <message>
   <source>Points by height</source>
   <translation>Punkte nach Höhe</translation>
  </message>
  <message>
   <source>Points by intensity</source>
   <translation>Punkte nach Intensität</translation>
  </message>
  <message>
   <source>Points by its own colour</source>
   <translation>Punkte in eigener Farbe</translation>
  </message>
  <message>
   <source>Points by plane</source>
   <translation>Punkte nach Ebene</translation>
  </message>
  <message>
   <source>Points by {0}</source>
   <translation>Punkte nach {0}</translation>
  </message>
  <message>
   <source>Points farther from their sensor are dropped.</source>
   <translation>Punkte, die weiter vom Sensor entfernt sind, entfallen.</translation>
  </message>
  <message>
   <source>Points nearer to their sensor are dropped.</source>
   <translation>Punkte, die näher am Sensor liegen, entfallen.</translation>
  </message>
  <message>
   <source>Points refer to the scans {0} to {1}, the trajectory has the rows 0 to {2}; give the trajectory of this survey.</source>
   <translation>Die Punkte beziehen sich auf die Scans {0} bis {1}, die Trajektorie hat die Zeilen 0 bis {2}; die Trajektorie dieser Aufnahme angeben.</translation>
  </message>
  <message>
   <source>Polygon file format: ASCII or binary, optional scan_id</source>
   <translation>Polygon-Dateiformat: Text oder binär, scan_id wenn vorhanden</translation>
  </message>
  <message>
   <source>Poses are taken as {0} and {1} depth units as a metre</source>
   <translation>Die Posen gelten als {0} und {1} Tiefeneinheiten als ein Meter</translation>
  </message>
  <message>
   <source>Predicted</source>
   <translation>Vorhergesagt</translation>
  </message>
  <message>
   <source>Predicted floor</source>
   <translation>Vorhergesagter Boden</translation>
  </message>
  <message>
   <source>Preferences</source>
   <translation>Voreinstellungen</translation>
  </message>
  <message>
   <source>Preferences…</source>
   <translation>Voreinstellungen…</translation>
  </message>
  <message>
   <source>Preparing for the first survey (only once)</source>
   <translation>Vorbereitung auf die erste Aufnahme (nur einmal)</translation>
  </message>
  <message>
   <source>Presets</source>
   <translation>Vorgaben</translation>
  </message>
  <message>
   <source>Quit</source>
   <translation>Beenden</translation>
  </message>
  <message>
   <source>ROS 1 and ROS 2 bags, MCAP: PointCloud2, LaserScan or depth images of one or several sensors with TF or odometry</source>
   <translation>ROS-1- und ROS-2-Bags, MCAP: PointCloud2, LaserScan oder Tiefenbilder eines oder mehrerer Sensoren mit TF oder Odometrie</translation>
  </message>
  <message>
   <source>ROS bag</source>
   <translation>ROS-Bag</translation>
  </message>
  <message>
   <source>ROS bags</source>
   <translation>ROS-Bags</translation>
  </message>
  <message>
   <source>ROS recording</source>
   <translation>ROS-Aufzeichnung</translation>
  </message>
  <message>
   <source>Rays crossed the wall here</source>
   <translation>Strahlen gingen hier durch die Wand</translation>
  </message>
  <message>
   <source>Rays through a voxel that make it free.</source>
   <translation>Strahlen durch ein Voxel, die es frei machen.</translation>
  </message>
  <message>
   <source>Reach</source>
   <translation>Reichweite</translation>
  </message>
  <message>
   <source>Read the survey once more and plan it from nothing.</source>
   <translation>Die Aufnahme noch einmal lesen und von Grund auf planen.</translation>
  </message>
  <message>
   <source>Reading points</source>
   <translation>Punkte lesen</translation>
  </message>
  <message>
   <source>Reading {0}</source>
   <translation>{0} lesen</translation>
  </message>
  <message>
   <source>Reading {0} needs the library {1}, which cannot be loaded; install it with: pip install '{2}'.</source>
   <translation>Um {0} zu lesen, fehlt die Bibliothek {1} oder lässt sich nicht laden; installieren mit: pip install '{2}'.</translation>
  </message>
  <message>
   <source>Recent</source>
   <translation>Zuletzt</translation>
  </message>
  <message>
   <source>Recent files</source>
   <translation>Letzte Dateien</translation>
  </message>
  <message>
   <source>Recess</source>
   <translation>Nische</translation>
  </message>
  <message>
   <source>Recover</source>
   <translation>Wiederherstellen</translation>
  </message>
  <message>
   <source>Rectangles</source>
   <translation>Rechtecke</translation>
  </message>
  <message>
   <source>Rectangles of more total cells a free cell are pruned; what only they cover is reported.</source>
   <translation>Rechtecke mit mehr Zellen je freier Zelle entfallen; was nur sie überdecken, wird gemeldet.</translation>
  </message>
  <message>
   <source>Redo</source>
   <translation>Wiederholen</translation>
  </message>
  <message>
   <source>Region classifier {0} gave region {1} the label {2}, which is not a word; choose another with labels.classifier.</source>
   <translation>Die Einordnung {0} gab Region {1} die Art {2}, die kein Wort ist; mit labels.classifier eine andere wählen.</translation>
  </message>
  <message>
   <source>Region {name}</source>
   <translation>Region {name}</translation>
  </message>
  <message>
   <source>Regions</source>
   <translation>Regionen</translation>
  </message>
  <message>
   <source>Regions of more total cells a free cell are dropped (paper: 1000).</source>
   <translation>Regionen mit mehr Zellen je freier Zelle entfallen (Artikel: 1000).</translation>
  </message>
  <message>
   <source>Regions {0} do not touch: they cannot be merged.</source>
   <translation>Die Regionen {0} berühren sich nicht: Sie lassen sich nicht vereinen.</translation>
  </message>
  <message>
   <source>Regions, doors, planes, segments and predicted space for GIS, scripts and robots.</source>
   <translation>Regionen, Türen, Ebenen, Segmente und vorhergesagter Raum für GIS, Skripte und Roboter.</translation>
  </message>
  <message>
   <source>Regions: connected unions of chosen rectangles.</source>
   <translation>Regionen: zusammenhängende Vereinigungen gewählter Rechtecke.</translation>
  </message>
  <message>
   <source>Reject door</source>
   <translation>Tür verwerfen</translation>
  </message>
  <message>
   <source>Reject {0}</source>
   <translation>{0} verwerfen</translation>
  </message>
  <message>
   <source>Relabel region</source>
   <translation>Region bezeichnen</translation>
  </message>
  <message>
   <source>Relabel region…</source>
   <translation>Region bezeichnen…</translation>
  </message>
  <message>
   <source>Release</source>
   <translation>Freigeben</translation>
  </message>
  <message>
   <source>Release {0}</source>
   <translation>{0} freigeben</translation>
  </message>
  <message>
   <source>Remove the measurement</source>
   <translation>Messung entfernen</translation>
  </message>
  <message>
   <source>Remove {0}</source>
   <translation>{0} entfernen</translation>
  </message>
  <message>
   <source>Rename region</source>
   <translation>Region umbenennen</translation>
  </message>
  <message>
   <source>Rename region {0} to {1}</source>
   <translation>Region {0} in {1} umbenennen</translation>
  </message>
  <message>
   <source>Rename region…</source>
   <translation>Region umbenennen…</translation>
  </message>
  <message>
   <source>Replay the run</source>
   <translation>Fahrt nachspielen</translation>
  </message>
  <message>
   <source>Replaying the run</source>
   <translation>Fahrt nachspielen</translation>
  </message>
  <message>
   <source>Reset all settings</source>
   <translation>Alle Einstellungen zurücksetzen</translation>
  </message>
  <message>
   <source>Reset settings</source>
   <translation>Einstellungen zurücksetzen</translation>
  </message>
  <message>
   <source>Residual</source>
   <translation>Restabweichung</translation>
  </message>
  <message>
   <source>Resize door…</source>
   <translation>Türbreite ändern…</translation>
  </message>
  <message>
   <source>Resize it</source>
   <translation>Ändert ihre Breite</translation>
  </message>
  <message>
   <source>Resized by hand</source>
   <translation>Breite von Hand geändert</translation>
  </message>
  <message>
   <source>Right click</source>
   <translation>Rechtsklick</translation>
  </message>
  <message>
   <source>Risk</source>
   <translation>Risiko</translation>
  </message>
  <message>
   <source>Room</source>
   <translation>Raum</translation>
  </message>
  <message>
   <source>Room or corridor, by perimeter and turning distance</source>
   <translation>Raum oder Flur, nach Umfang und Drehabstand</translation>
  </message>
  <message>
   <source>Room {0}</source>
   <translation>Raum {0}</translation>
  </message>
  <message>
   <source>Room, corridor or any other word</source>
   <translation>Room, corridor oder ein anderes Wort</translation>
  </message>
  <message>
   <source>Room, corridor, or a word of your own.</source>
   <translation>Room, corridor oder ein eigenes Wort.</translation>
  </message>
  <message>
   <source>Rooms and corridors.</source>
   <translation>Räume und Flure.</translation>
  </message>
  <message>
   <source>Run</source>
   <translation>Fahrt</translation>
  </message>
  <message>
   <source>S</source>
   <translation>S</translation>
  </message>
  <message>
   <source>Save</source>
   <translation>Speichern</translation>
  </message>
  <message>
   <source>Save as…</source>
   <translation>Speichern unter…</translation>
  </message>
  <message>
   <source>Save the picture</source>
   <translation>Das Bild speichern</translation>
  </message>
  <message>
   <source>Save the project</source>
   <translation>Das Projekt speichern</translation>
  </message>
  <message>
   <source>Save the project under another name.</source>
   <translation>Das Projekt unter anderem Namen speichern.</translation>
  </message>
  <message>
   <source>Save the project: survey by reference, settings, corrections, checks, view.</source>
   <translation>Das Projekt speichern: Verweis auf die Aufnahme, Einstellungen, Korrekturen, Messungen, Ansicht.</translation>
  </message>
  <message>
   <source>Save the session as a script</source>
   <translation>Die Sitzung als Skript speichern</translation>
  </message>
  <message>
   <source>Save the session as a script…</source>
   <translation>Sitzung als Skript speichern…</translation>
  </message>
  <message>
   <source>Saved {0}.</source>
   <translation>{0} gespeichert.</translation>
  </message>
  <message>
   <source>Save…</source>
   <translation>Speichern…</translation>
  </message>
  <message>
   <source>Say where the survey of this project lies now.</source>
   <translation>Sagen, wo die Aufnahme dieses Projekts jetzt liegt.</translation>
  </message>
  <message>
   <source>Scale bar</source>
   <translation>Maßstab</translation>
  </message>
  <message>
   <source>Scan {0} of {1} has neither cartesian nor spherical coordinates (it has: {2}).</source>
   <translation>Scan {0} von {1} hat weder kartesische noch sphärische Koordinaten (er hat: {2}).</translation>
  </message>
  <message>
   <source>Screen</source>
   <translation>Bildschirm</translation>
  </message>
  <message>
   <source>Search settings</source>
   <translation>Suchen</translation>
  </message>
  <message>
   <source>Section box</source>
   <translation>Schnittquader</translation>
  </message>
  <message>
   <source>See the plan grow as the sensor moved: one plan every 20 s of run time.</source>
   <translation>Den Plan mit dem Weg des Sensors wachsen sehen: alle 20 s der Fahrt ein Plan.</translation>
  </message>
  <message>
   <source>See the plan grow as the sensor moved: one plan for every 20 s of the run.</source>
   <translation>Den Plan mit dem Weg des Sensors wachsen sehen: ein Plan für je 20 s der Fahrt.</translation>
  </message>
  <message>
   <source>Seen</source>
   <translation>Gesehen</translation>
  </message>
  <message>
   <source>Segment</source>
   <translation>Wandstück</translation>
  </message>
  <message>
   <source>Segment {name}</source>
   <translation>Wandstück {name}</translation>
  </message>
  <message>
   <source>Segments</source>
   <translation>Wandstücke</translation>
  </message>
  <message>
   <source>Segments of less observed surface are dropped.</source>
   <translation>Wandstücke mit weniger gesehener Fläche entfallen.</translation>
  </message>
  <message>
   <source>Select</source>
   <translation>Wählen</translation>
  </message>
  <message>
   <source>Select a measurement first; then it can be removed.</source>
   <translation>Zuerst eine Messung wählen; dann lässt sie sich entfernen.</translation>
  </message>
  <message>
   <source>Select a wall or a door.</source>
   <translation>Eine Wand oder eine Tür wählen.</translation>
  </message>
  <message>
   <source>Select a wall, a door or a check first; regions are merged, not deleted.</source>
   <translation>Zuerst eine Wand, eine Tür oder eine Messung wählen; Regionen werden vereint, nicht gelöscht.</translation>
  </message>
  <message>
   <source>Select a wall, a door or a region first.</source>
   <translation>Zuerst eine Wand, eine Tür oder eine Region wählen.</translation>
  </message>
  <message>
   <source>Select by name</source>
   <translation>Nach Namen wählen</translation>
  </message>
  <message>
   <source>Select nothing</source>
   <translation>Nichts wählen</translation>
  </message>
  <message>
   <source>Select something first; then it can be brought into view.</source>
   <translation>Zuerst etwas wählen; dann lässt es sich ins Bild holen.</translation>
  </message>
  <message>
   <source>Select {0} {1}{2} first.</source>
   <translation>Zuerst {0} {1}{2} wählen.</translation>
  </message>
  <message>
   <source>Select; with Ctrl add to the selection</source>
   <translation>Wählt; mit Strg kommt es zur Auswahl hinzu</translation>
  </message>
  <message>
   <source>Selection</source>
   <translation>Auswahl</translation>
  </message>
  <message>
   <source>Set a measured length…</source>
   <translation>Gemessene Länge setzen…</translation>
  </message>
  <message>
   <source>Set cover of the free space, then connected unions</source>
   <translation>Überdeckung des Freiraums, dann zusammenhängende Vereinigungen</translation>
  </message>
  <message>
   <source>Set the view…</source>
   <translation>Ansicht einstellen…</translation>
  </message>
  <message>
   <source>Set {0} to {1}</source>
   <translation>{0} auf {1} setzen</translation>
  </message>
  <message>
   <source>Setting: {name}</source>
   <translation>Einstellung: {name}</translation>
  </message>
  <message>
   <source>Setting: {stage}: {name}</source>
   <translation>Einstellung: {stage}: {name}</translation>
  </message>
  <message>
   <source>Settings</source>
   <translation>Einstellungen</translation>
  </message>
  <message>
   <source>Settings that belong together, with the reason why</source>
   <translation>Einstellungen, die zusammengehören, mit ihrem Grund</translation>
  </message>
  <message>
   <source>Share of a patch that must lie under seen ceiling or over seen floor.</source>
   <translation>Anteil eines Flecks, der unter gesehener Decke oder über gesehenem Boden liegen muss.</translation>
  </message>
  <message>
   <source>Share of hits among hits and misses from which a voxel is occupied.</source>
   <translation>Anteil der Treffer an Treffern und Durchgängen, ab dem ein Voxel belegt ist.</translation>
  </message>
  <message>
   <source>Share of its floor seen free</source>
   <translation>Anteil ihres Bodens, der frei gesehen wurde</translation>
  </message>
  <message>
   <source>Share of the floor that was seen free; the rest is predicted</source>
   <translation>Anteil des Bodens, der frei gesehen wurde; der Rest ist vorhergesagt</translation>
  </message>
  <message>
   <source>Share of the wall along the two axes</source>
   <translation>Anteil der Wände längs der beiden Achsen</translation>
  </message>
  <message>
   <source>Share of walls at other angles from which a space gets the map's outline.</source>
   <translation>Anteil der Wände in anderen Winkeln, ab dem ein Raum den Umriss der Karte bekommt.</translation>
  </message>
  <message>
   <source>Shortcuts</source>
   <translation>Tastenkürzel</translation>
  </message>
  <message>
   <source>Shortcuts and gestures</source>
   <translation>Tastenkürzel und Gesten</translation>
  </message>
  <message>
   <source>Shorter segments are dropped.</source>
   <translation>Kürzere Wandstücke entfallen.</translation>
  </message>
  <message>
   <source>Shorter sides are pruned (paper: 1 m).</source>
   <translation>Kürzere Seiten entfallen (Artikel: 1 m).</translation>
  </message>
  <message>
   <source>Show</source>
   <translation>Zeigen</translation>
  </message>
  <message>
   <source>Show a pane…</source>
   <translation>Ansicht zeigen…</translation>
  </message>
  <message>
   <source>Show a storey</source>
   <translation>Geschoss zeigen</translation>
  </message>
  <message>
   <source>Show a storey…</source>
   <translation>Geschoss zeigen…</translation>
  </message>
  <message>
   <source>Show it in the panes</source>
   <translation>In den Ansichten zeigen</translation>
  </message>
  <message>
   <source>Show lengths and areas in feet and inches.</source>
   <translation>Längen und Flächen in Fuß und Zoll zeigen.</translation>
  </message>
  <message>
   <source>Show only rows with all of these words (Ctrl+F)</source>
   <translation>Nur Zeilen mit allen diesen Wörtern zeigen (Strg+F)</translation>
  </message>
  <message>
   <source>Show or hide</source>
   <translation>Zeigen oder ausblenden</translation>
  </message>
  <message>
   <source>Show or hide the scale bar of the plan panes.</source>
   <translation>Den Maßstab der Planansichten zeigen oder ausblenden.</translation>
  </message>
  <message>
   <source>Show or hide: dimensions.</source>
   <translation>Zeigen oder ausblenden: Maße.</translation>
  </message>
  <message>
   <source>Show or hide: doors.</source>
   <translation>Zeigen oder ausblenden: Türen.</translation>
  </message>
  <message>
   <source>Show or hide: free space.</source>
   <translation>Zeigen oder ausblenden: Freiraum.</translation>
  </message>
  <message>
   <source>Show or hide: planes.</source>
   <translation>Zeigen oder ausblenden: Ebenen.</translation>
  </message>
  <message>
   <source>Show or hide: points.</source>
   <translation>Zeigen oder ausblenden: Punkte.</translation>
  </message>
  <message>
   <source>Show or hide: regions.</source>
   <translation>Zeigen oder ausblenden: Regionen.</translation>
  </message>
  <message>
   <source>Show or hide: trajectory.</source>
   <translation>Zeigen oder ausblenden: Weg.</translation>
  </message>
  <message>
   <source>Show or hide: {0}.</source>
   <translation>Zeigen oder ausblenden: {0}.</translation>
  </message>
  <message>
   <source>Show storey {0}</source>
   <translation>Geschoss {0} zeigen</translation>
  </message>
  <message>
   <source>Show the evidence on the other face of the wall</source>
   <translation>Die Belege auf der anderen Seite der Wand zeigen</translation>
  </message>
  <message>
   <source>Side</source>
   <translation>Seite</translation>
  </message>
  <message>
   <source>Side of a voxel of the occupancy map (paper: 0.1 m).</source>
   <translation>Seite eines Voxels der Belegungskarte (Artikel: 0,1 m).</translation>
  </message>
  <message>
   <source>Side of the window in which the direction of a surface is fitted.</source>
   <translation>Seite des Fensters, in dem die Richtung einer Fläche bestimmt wird.</translation>
  </message>
  <message>
   <source>Sides along which less than half was seen; they are dashed</source>
   <translation>Seiten, von denen weniger als die Hälfte gesehen wurde; sie sind gestrichelt</translation>
  </message>
  <message>
   <source>Sightings of one wall differ by no more than this once near ones are joined.</source>
   <translation>Sichtungen einer Wand weichen höchstens so weit ab, wenn nahe schon vereint sind.</translation>
  </message>
  <message>
   <source>Size</source>
   <translation>Größe</translation>
  </message>
  <message>
   <source>Slice height</source>
   <translation>Schnitthöhe</translation>
  </message>
  <message>
   <source>Sliver</source>
   <translation>Splitter</translation>
  </message>
  <message>
   <source>Smaller enclosed spaces are dropped.</source>
   <translation>Kleinere umschlossene Räume entfallen.</translation>
  </message>
  <message>
   <source>Smaller isolated objects are furniture, whatever their shape.</source>
   <translation>Kleinere freistehende Objekte sind Möbel, welche Form sie auch haben.</translation>
  </message>
  <message>
   <source>Smaller patches of free cells do not drive the cover.</source>
   <translation>Kleinere Flecken freier Zellen treiben die Überdeckung nicht an.</translation>
  </message>
  <message>
   <source>Smaller regions are dropped.</source>
   <translation>Kleinere Regionen entfallen.</translation>
  </message>
  <message>
   <source>Smallest response of the matched filter, 1 being a clean aperture.</source>
   <translation>Kleinste Antwort des angepassten Filters; 1 ist eine saubere Öffnung.</translation>
  </message>
  <message>
   <source>Smoothing</source>
   <translation>Glättung</translation>
  </message>
  <message>
   <source>Solver</source>
   <translation>Löser</translation>
  </message>
  <message>
   <source>Some poses of {0} reflect the axes of the camera and some do not: they are damaged.</source>
   <translation>Einige Posen von {0} spiegeln die Achsen der Kamera und andere nicht: Sie sind beschädigt.</translation>
  </message>
  <message>
   <source>Speak English.</source>
   <translation>Englisch sprechen.</translation>
  </message>
  <message>
   <source>Speak German.</source>
   <translation>Deutsch sprechen.</translation>
  </message>
  <message>
   <source>Split</source>
   <translation>Teilen</translation>
  </message>
  <message>
   <source>Split by hand</source>
   <translation>Von Hand geteilt</translation>
  </message>
  <message>
   <source>Split region</source>
   <translation>Region teilen</translation>
  </message>
  <message>
   <source>Stage</source>
   <translation>Schritt</translation>
  </message>
  <message>
   <source>Standard deviation of the Gaussian whose derivative gives the gradient.</source>
   <translation>Standardabweichung der Gaußkurve, deren Ableitung den Gradienten gibt.</translation>
  </message>
  <message>
   <source>Standard error</source>
   <translation>Standardfehler</translation>
  </message>
  <message>
   <source>Step of the search for the sharpest walls.</source>
   <translation>Schrittweite der Suche nach den schärfsten Wänden.</translation>
  </message>
  <message>
   <source>Stop what runs; the last plan stays.</source>
   <translation>Anhalten, was läuft; der letzte Plan bleibt.</translation>
  </message>
  <message>
   <source>Storey</source>
   <translation>Geschoss</translation>
  </message>
  <message>
   <source>Storey 0</source>
   <translation>Geschoss 0</translation>
  </message>
  <message>
   <source>Storey above</source>
   <translation>Geschoss darüber</translation>
  </message>
  <message>
   <source>Storey below</source>
   <translation>Geschoss darunter</translation>
  </message>
  <message>
   <source>Storey {number}, {height} up</source>
   <translation>Geschoss {number}, {height} höher</translation>
  </message>
  <message>
   <source>Storeys</source>
   <translation>Geschosse</translation>
  </message>
  <message>
   <source>Storeys of one survey, from its floors and ceilings.</source>
   <translation>Geschosse einer Aufnahme, aus ihren Böden und Decken.</translation>
  </message>
  <message>
   <source>Support</source>
   <translation>Stützung</translation>
  </message>
  <message>
   <source>Sure</source>
   <translation>Sicher</translation>
  </message>
  <message>
   <source>Surface</source>
   <translation>Oberfläche</translation>
  </message>
  <message>
   <source>Surface that was observed</source>
   <translation>Fläche, die gesehen wurde</translation>
  </message>
  <message>
   <source>Surfaces at most this deep behind a wall of the same facing are its recesses, not paired.</source>
   <translation>Flächen, die höchstens so tief hinter einer Wand gleicher Richtung liegen, sind deren Nischen und werden nicht gepaart.</translation>
  </message>
  <message>
   <source>Surfaces this near to a plane are the same wall: its other face, frames, leaves.</source>
   <translation>Flächen, die einer Ebene so nahe sind, sind dieselbe Wand: ihre andere Seite, Rahmen, Türblätter.</translation>
  </message>
  <message>
   <source>Surveys and projects</source>
   <translation>Aufnahmen und Projekte</translation>
  </message>
  <message>
   <source>Switch off {0}</source>
   <translation>{0} ausschalten</translation>
  </message>
  <message>
   <source>Switch the selected wall off, reject the selected door, remove the selected check.</source>
   <translation>Die gewählte Wand ausschalten, die gewählte Tür verwerfen, die gewählte Messung entfernen.</translation>
  </message>
  <message>
   <source>Switch wall off</source>
   <translation>Wand ausschalten</translation>
  </message>
  <message>
   <source>Switched off by hand</source>
   <translation>Von Hand ausgeschaltet</translation>
  </message>
  <message>
   <source>Take back all corrections</source>
   <translation>Alle Korrekturen zurücknehmen</translation>
  </message>
  <message>
   <source>Take back all that was said of it by hand: the machine decides again.</source>
   <translation>Alles zurücknehmen, was von Hand darüber gesagt wurde: Das Programm entscheidet wieder.</translation>
  </message>
  <message>
   <source>Take the last step back; there is no limit.</source>
   <translation>Den letzten Schritt zurücknehmen; ohne Grenze.</translation>
  </message>
  <message>
   <source>Take the selected row out of the ground-truth table.</source>
   <translation>Die gewählte Zeile aus der Kontrolltabelle nehmen.</translation>
  </message>
  <message>
   <source>Taken for</source>
   <translation>Gehalten für</translation>
  </message>
  <message>
   <source>Telling its storeys apart</source>
   <translation>Geschosse unterscheiden</translation>
  </message>
  <message>
   <source>Text, one point a line: XYZ, PTS, TXT, CSV</source>
   <translation>Text, ein Punkt je Zeile: XYZ, PTS, TXT, CSV</translation>
  </message>
  <message>
   <source>The OctoMap {0} ends after its header.</source>
   <translation>Die OctoMap {0} endet nach ihrem Kopf.</translation>
  </message>
  <message>
   <source>The OctoMap {0} has voxels of {1} m, which no building needs.</source>
   <translation>Die OctoMap {0} hat Voxel von {1} m, wie sie kein Gebäude braucht.</translation>
  </message>
  <message>
   <source>The OctoMap {0} holds more than {1} voxels of {2} m; it is damaged, or needs a coarser resolution.</source>
   <translation>Die OctoMap {0} enthält mehr als {1} Voxel von {2} m; sie ist beschädigt oder braucht eine gröbere Auflösung.</translation>
  </message>
  <message>
   <source>The OctoMap {0} is damaged: a node near byte {1} lies deeper than the {2} levels of an OctoMap.</source>
   <translation>Die OctoMap {0} ist beschädigt: Ein Knoten nahe Byte {1} liegt tiefer als die {2} Ebenen einer OctoMap.</translation>
  </message>
  <message>
   <source>The OctoMap {0} is truncated: its tree goes on after {1} bytes.</source>
   <translation>Die OctoMap {0} ist abgeschnitten: Ihr Baum geht nach {1} Bytes weiter.</translation>
  </message>
  <message>
   <source>The best cover by integer programming instead of the greedy one; slower, rarely different.</source>
   <translation>Die beste Überdeckung durch ganzzahlige Optimierung statt der gierigen; langsamer, selten anders.</translation>
  </message>
  <message>
   <source>The coordinates of {0} are degrees ({1}); project them to metres first.</source>
   <translation>Die Koordinaten von {0} sind Grad ({1}); zuerst in Meter projizieren.</translation>
  </message>
  <message>
   <source>The corrections are not a list.</source>
   <translation>Die Korrekturen sind keine Liste.</translation>
  </message>
  <message>
   <source>The corrections made since the last save would be lost.</source>
   <translation>Die Korrekturen seit dem letzten Speichern gingen verloren.</translation>
  </message>
  <message>
   <source>The depth image {0} claims {1} x {2} pixels; it is damaged.</source>
   <translation>Das Tiefenbild {0} gibt {1} x {2} Pixel an; es ist beschädigt.</translation>
  </message>
  <message>
   <source>The depth image {0} has {1} pixels of shape {2}, not depth.</source>
   <translation>Das Tiefenbild {0} hat {1}-Pixel der Form {2}, keine Tiefe.</translation>
  </message>
  <message>
   <source>The depth image {0} is damaged.</source>
   <translation>Das Tiefenbild {0} ist beschädigt.</translation>
  </message>
  <message>
   <source>The depth image {0} is no PNG file.</source>
   <translation>Das Tiefenbild {0} ist keine PNG-Datei.</translation>
  </message>
  <message>
   <source>The description of the glTF scene {0} is too large ({1} bytes).</source>
   <translation>Die Beschreibung der glTF-Szene {0} ist zu groß ({1} Bytes).</translation>
  </message>
  <message>
   <source>The door accepted at {0} is not there any more.</source>
   <translation>Die bei {0} bestätigte Tür ist nicht mehr da.</translation>
  </message>
  <message>
   <source>The door added at {0} is in no wall: there is none within {1} m.</source>
   <translation>Die bei {0} hinzugefügte Tür liegt in keiner Wand: Im Umkreis von {1} m ist keine.</translation>
  </message>
  <message>
   <source>The door added at {0} is too narrow for one.</source>
   <translation>Die bei {0} hinzugefügte Tür ist zu schmal für eine Tür.</translation>
  </message>
  <message>
   <source>The door at {0} cannot be {1} m wide.</source>
   <translation>Die Tür bei {0} kann nicht {1} m breit sein.</translation>
  </message>
  <message>
   <source>The door {0} at {1} is not there any more.</source>
   <translation>Die von Hand geänderte Tür ({0}) bei {1} ist nicht mehr da.</translation>
  </message>
  <message>
   <source>The door {0} by hand at {1} does not lie between two regions, and is left out.</source>
   <translation>Die von Hand geänderte Tür ({0}) bei {1} liegt nicht zwischen zwei Regionen; sie wird weggelassen.</translation>
  </message>
  <message>
   <source>The drawing of plan.svg on one page at true scale, to print and to hand over.</source>
   <translation>Die Zeichnung von plan.svg auf einem Blatt im wahren Maßstab, zum Drucken und Weitergeben.</translation>
  </message>
  <message>
   <source>The exact cover of {0} groups of free cells by {1} rectangles was not found within {2} s; raise cover.time_limit or use cover.solver greedy.</source>
   <translation>Die exakte Überdeckung von {0} Gruppen freier Zellen durch {1} Rechtecke wurde in {2} s nicht gefunden; cover.time_limit erhöhen oder cover.solver greedy nehmen.</translation>
  </message>
  <message>
   <source>The exact cover of {0} parts of the plan was not proven optimal within {1} s; raise cover.time_limit.</source>
   <translation>Für {0} Teile des Plans wurde in {1} s nicht bewiesen, dass ihre Überdeckung die beste ist; cover.time_limit erhöhen.</translation>
  </message>
  <message>
   <source>The fewest planes that explain all segments</source>
   <translation>Die wenigsten Ebenen, die alle Wandstücke erklären</translation>
  </message>
  <message>
   <source>The file is left-handed, as asked: its mirror image is planned, y of the world reversed.</source>
   <translation>Die Datei ist wie verlangt linkshändig: Ihr Spiegelbild wird geplant, y der Welt umgekehrt.</translation>
  </message>
  <message>
   <source>The file is left-handed, its poses reflect the sensor's axes: its mirror image is planned, y of the world reversed; --set input.mirrored=no takes it as it is.</source>
   <translation>Die Datei ist linkshändig, ihre Posen spiegeln die Achsen des Sensors: Ihr Spiegelbild wird geplant, y der Welt umgekehrt; mit --set input.mirrored=no gilt sie, wie sie ist.</translation>
  </message>
  <message>
   <source>The file stores them in 32 bits, which resolves only {0} m there.</source>
   <translation>Die Datei speichert sie mit 32 Bit, was dort nur {0} m auflöst.</translation>
  </message>
  <message>
   <source>The file {0} beside the scene is too large ({1} bytes).</source>
   <translation>Die Datei {0} neben der Szene ist zu groß ({1} Bytes).</translation>
  </message>
  <message>
   <source>The file's axes are left-handed, its plan would be a mirror image; auto: where its poses say so.</source>
   <translation>Die Achsen der Datei sind linkshändig, ihr Plan wäre spiegelverkehrt; auto: wo ihre Posen es sagen.</translation>
  </message>
  <message>
   <source>The file's up axis.</source>
   <translation>Die Hochachse der Datei.</translation>
  </message>
  <message>
   <source>The file's {0} axis is taken as up (flat layers, low extent, level path); force it with input.up.</source>
   <translation>Die {0}-Achse der Datei gilt als Hochachse (flache Lagen, geringe Höhe, ebener Weg); vorgeben mit input.up.</translation>
  </message>
  <message>
   <source>The file's {0} axis is up, as asked.</source>
   <translation>Die {0}-Achse der Datei weist nach oben, wie verlangt.</translation>
  </message>
  <message>
   <source>The first three columns of {0} are taken as x, y and z.</source>
   <translation>Die ersten drei Spalten von {0} gelten als x, y und z.</translation>
  </message>
  <message>
   <source>The floor plan appears here once a survey is planned.</source>
   <translation>Hier erscheint der Grundriss nach dem Planen.</translation>
  </message>
  <message>
   <source>The floor plan as a picture into the clipboard.</source>
   <translation>Den Grundriss als Bild in die Zwischenablage.</translation>
  </message>
  <message>
   <source>The floor plan large.</source>
   <translation>Der Grundriss groß.</translation>
  </message>
  <message>
   <source>The folder {0} holds no scans (numbered point clouds like 000000.ply) and no point cloud.</source>
   <translation>Der Ordner {0} enthält keine Scans (nummerierte Punktwolken wie 000000.ply) und keine Punktwolke.</translation>
  </message>
  <message>
   <source>The folder {0} holds no {1}; 'floorcast plan INPUT --out {2}' makes one.</source>
   <translation>Der Ordner {0} enthält keine Datei {1}; 'floorcast plan INPUT --out {2}' erzeugt sie.</translation>
  </message>
  <message>
   <source>The folder {0} holds {1} depth images but no trajectory ({2}, …); name one with --trajectory.</source>
   <translation>Der Ordner {0} enthält {1} Tiefenbilder, aber keine Trajektorie ({2}, …); mit --trajectory eine angeben.</translation>
  </message>
  <message>
   <source>The folder {0} holds {1} depth images, the trajectory {2} has {3} poses: one for each image is needed.</source>
   <translation>Der Ordner {0} enthält {1} Tiefenbilder, die Trajektorie {2} hat {3} Posen: Für jedes Bild wird eine gebraucht.</translation>
  </message>
  <message>
   <source>The folder {0} holds {1} scans (numbers {2} to {3}), the trajectory has {4} rows: one row for each scan is needed.</source>
   <translation>Der Ordner {0} enthält {1} Scans (Nummern {2} bis {3}), die Trajektorie hat {4} Zeilen: Für jeden Scan wird eine Zeile gebraucht.</translation>
  </message>
  <message>
   <source>The folder {0} holds {1} scans but no trajectory to place them with; add trajectory.tum or name one with --trajectory.</source>
   <translation>Der Ordner {0} enthält {1} Scans, aber keine Trajektorie, die ihnen ihre Lage gibt; trajectory.tum dazulegen oder mit --trajectory eine angeben.</translation>
  </message>
  <message>
   <source>The folder {0} holds {1} versions of a point cloud ({2}); name one of them.</source>
   <translation>Der Ordner {0} enthält {1} Fassungen einer Punktwolke ({2}); eine davon angeben.</translation>
  </message>
  <message>
   <source>The folder {0} looks like {1} but holds no depth images.</source>
   <translation>Der Ordner {0} sieht aus wie {1}, enthält aber keine Tiefenbilder.</translation>
  </message>
  <message>
   <source>The given trajectory places the scans by their times.</source>
   <translation>Die angegebene Trajektorie ordnet die Scans nach ihren Zeiten ein.</translation>
  </message>
  <message>
   <source>The header of the OctoMap {0} has no valid 'res' and 'size'.</source>
   <translation>Der Kopf der OctoMap {0} hat kein gültiges 'res' und 'size'.</translation>
  </message>
  <message>
   <source>The height at which most free space was seen</source>
   <translation>Die Höhe, in der am meisten Freiraum gesehen wurde</translation>
  </message>
  <message>
   <source>The height of the laser is not in the log: its plane is taken as z = 0.</source>
   <translation>Die Höhe des Lasers steht nicht im Protokoll: Seine Ebene gilt als z = 0.</translation>
  </message>
  <message>
   <source>The input {0} does not exist.</source>
   <translation>Die Eingabe {0} gibt es nicht.</translation>
  </message>
  <message>
   <source>The input {0} is a link to something that does not exist.</source>
   <translation>Die Eingabe {0} ist ein Verweis auf etwas, das es nicht gibt.</translation>
  </message>
  <message>
   <source>The intrinsics in {0} are in no form that is known.</source>
   <translation>Die Kameradaten in {0} haben keine bekannte Form.</translation>
  </message>
  <message>
   <source>The intrinsics in {0} are no 3 x 3 or 4 x 4 matrix.</source>
   <translation>Die Kameradaten in {0} sind keine Matrix von 3 x 3 oder 4 x 4.</translation>
  </message>
  <message>
   <source>The intrinsics in {0} are not four positive numbers (fx, fy, cx, cy).</source>
   <translation>Die Kameradaten in {0} sind nicht vier positive Zahlen (fx, fy, cx, cy).</translation>
  </message>
  <message>
   <source>The intrinsics on {0} of {1} are none (fx and fy must be positive).</source>
   <translation>Die Kameradaten auf {0} von {1} sind keine (fx und fy müssen positiv sein).</translation>
  </message>
  <message>
   <source>The last scan of {0} announces {1} points and ends after {2}; those are used.</source>
   <translation>Der letzte Scan von {0} kündigt {1} Punkte an und endet nach {2}; diese werden genutzt.</translation>
  </message>
  <message>
   <source>The line drawn at {0} does not part region {1} in two of {2} m2.</source>
   <translation>Die Linie bei {0} teilt die Region {1} nicht in zwei von je {2} m².</translation>
  </message>
  <message>
   <source>The line drawn at {0} splits no region.</source>
   <translation>Die Linie bei {0} teilt keine Region.</translation>
  </message>
  <message>
   <source>The look has no such field ({0}).</source>
   <translation>Die Ansicht hat kein solches Feld ({0}).</translation>
  </message>
  <message>
   <source>The machine had said: {said}</source>
   <translation>Das Programm hatte gesagt: {said}</translation>
  </message>
  <message>
   <source>The map's image {0} does not exist beside its YAML file.</source>
   <translation>Das Bild {0} der Karte fehlt neben ihrer YAML-Datei.</translation>
  </message>
  <message>
   <source>The meshes of {0} are compressed by {1}, which is not read; save the scene without mesh compression.</source>
   <translation>Die Netze von {0} sind mit {1} komprimiert, was nicht gelesen wird; die Szene ohne Netzkompression speichern.</translation>
  </message>
  <message>
   <source>The minimum set of layout planes.</source>
   <translation>Die kleinste Menge von Wandebenen.</translation>
  </message>
  <message>
   <source>The numbers that the paper states, to compare with its figures. Doors of 0.8 to 1.2 m only.</source>
   <translation>Die Zahlen, die der Artikel nennt, zum Vergleich mit seinen Bildern. Nur Türen von 0,8 bis 1,2 m.</translation>
  </message>
  <message>
   <source>The package brings no text of its licence ({licence}).</source>
   <translation>Das Paket bringt keinen Text seiner Lizenz mit ({licence}).</translation>
  </message>
  <message>
   <source>The picture is in the clipboard.</source>
   <translation>Das Bild ist in der Zwischenablage.</translation>
  </message>
  <message>
   <source>The plan as the machine made it; undo brings your corrections back.</source>
   <translation>Der Plan, wie das Programm ihn gemacht hat; Rückgängig bringt die Korrekturen wieder.</translation>
  </message>
  <message>
   <source>The plan is not ready yet: export it when it is, or cancel what runs.</source>
   <translation>Der Plan ist noch nicht fertig: exportieren Sie ihn danach, oder brechen Sie ab, was läuft.</translation>
  </message>
  <message>
   <source>The plan of {0} x {1} m in voxels of {2} m</source>
   <translation>Der Plan von {0} x {1} m in Voxeln von {2} m</translation>
  </message>
  <message>
   <source>The plugin {0} ({1}) was switched off: {2}.</source>
   <translation>Die Erweiterung {0} ({1}) wurde abgeschaltet: {2}.</translation>
  </message>
  <message>
   <source>The plugin {0} failed while {1} ({2}) and was switched off.</source>
   <translation>Die Erweiterung {0} scheiterte, während {1} ({2}), und wurde abgeschaltet.</translation>
  </message>
  <message>
   <source>The points of a scan must be numbers in rows of three, (N, 3): x, y and z in metres (given an array of shape {0} and type {1}); select or stack these three columns.</source>
   <translation>Die Punkte eines Scans müssen Zahlen in Zeilen zu dreien sein, (N, 3): x, y und z in Metern (angegeben: ein Feld der Form {0} vom Typ {1}); diese drei Spalten auswählen oder zusammenfügen.</translation>
  </message>
  <message>
   <source>The points of {0} carry no scan_id, so nobody knows when they were seen; a PLY with that property or a folder of scans can be replayed.</source>
   <translation>Die Punkte von {0} tragen keine scan_id, also weiß niemand, wann sie gesehen wurden; eine PLY mit dieser Eigenschaft oder ein Ordner von Scans lässt sich abspielen.</translation>
  </message>
  <message>
   <source>The points of {0} do not refer to a trajectory that could be corrected; leave drift.correct at false.</source>
   <translation>Die Punkte von {0} beziehen sich auf keine Trajektorie, die sich korrigieren ließe; drift.correct auf false lassen.</translation>
  </message>
  <message>
   <source>The points of {0} refer to scan {1}, the trajectory has only {2} rows; give the trajectory of this survey with --trajectory.</source>
   <translation>Die Punkte von {0} beziehen sich auf Scan {1}, die Trajektorie hat nur {2} Zeilen; mit --trajectory die Trajektorie dieser Aufnahme angeben.</translation>
  </message>
  <message>
   <source>The points spread over {0} x {1} m, too much for cells of {2} m; check the unit (--set input.unit=...), crop the survey, or enlarge voxels.size.</source>
   <translation>Die Punkte verteilen sich über {0} x {1} m, zu viel für Zellen von {2} m; die Einheit prüfen (--set input.unit=...), die Aufnahme zuschneiden oder voxels.size vergrößern.</translation>
  </message>
  <message>
   <source>The pose after line {0} of {1} is no rotation with a position.</source>
   <translation>Die Pose nach Zeile {0} von {1} ist keine Drehung mit einer Lage.</translation>
  </message>
  <message>
   <source>The pose of scan {0} of {1} has a quaternion that is no rotation.</source>
   <translation>Die Pose von Scan {0} in {1} hat eine Quaternion, die keine Drehung ist.</translation>
  </message>
  <message>
   <source>The pose of scan {0} of {1} holds a value that is not a finite number.</source>
   <translation>Die Pose von Scan {0} in {1} enthält einen Wert, der keine endliche Zahl ist.</translation>
  </message>
  <message>
   <source>The poses in or for {0} are from another time than its {1} scans on {2} (these begin at {3} s); give the trajectory of this recording.</source>
   <translation>Die Posen in oder für {0} sind aus einer anderen Zeit als die {1} Scans auf {2} (diese beginnen bei {3} s); die Trajektorie dieser Aufzeichnung angeben.</translation>
  </message>
  <message>
   <source>The ratio of widths for a passage.</source>
   <translation>Das Verhältnis der Breiten für einen Durchgang.</translation>
  </message>
  <message>
   <source>The recording was refused: its {0} bytes unpack without end.</source>
   <translation>Die Aufzeichnung wurde abgelehnt: Ihre {0} Bytes entpacken sich ohne Ende.</translation>
  </message>
  <message>
   <source>The region at {0}, labelled or named by hand, is gone.</source>
   <translation>Die von Hand bezeichnete oder benannte Region bei {0} gibt es nicht mehr.</translation>
  </message>
  <message>
   <source>The region at {0}, merged with others, is gone.</source>
   <translation>Die mit anderen vereinte Region bei {0} gibt es nicht mehr.</translation>
  </message>
  <message>
   <source>The regions at {0} stand in different buildings: they cannot be merged.</source>
   <translation>Die Regionen bei {0} stehen in verschiedenen Gebäuden: Sie lassen sich nicht vereinen.</translation>
  </message>
  <message>
   <source>The regions on its two sides</source>
   <translation>Die Regionen auf ihren beiden Seiten</translation>
  </message>
  <message>
   <source>The same for what is left uncovered and closed by speculated planes.</source>
   <translation>Dasselbe für das, was unbedeckt bleibt und durch vermutete Ebenen geschlossen wird.</translation>
  </message>
  <message>
   <source>The same scene in Open3D's own viewer.</source>
   <translation>Dieselbe Szene in Open3Ds eigener Anzeige.</translation>
  </message>
  <message>
   <source>The same with predicted floor free and guessed walls occupied: for planning ahead.</source>
   <translation>Dieselbe mit vorhergesagtem Boden als frei und geratenen Wänden als belegt: um vorauszuplanen.</translation>
  </message>
  <message>
   <source>The scan {0} was left out: {1}.</source>
   <translation>Der Scan {0} wurde ausgelassen: {1}.</translation>
  </message>
  <message>
   <source>The scans of {0} that were looked at hold no points.</source>
   <translation>Die Scans von {0}, die angesehen wurden, enthalten keine Punkte.</translation>
  </message>
  <message>
   <source>The scene needs the file {0} beside it, which is not there.</source>
   <translation>Die Szene braucht die Datei {0} neben sich, die dort fehlt.</translation>
  </message>
  <message>
   <source>The scene refers to {0} outside its own folder, which is refused.</source>
   <translation>Die Szene verweist auf {0} außerhalb ihres Ordners; das wird abgelehnt.</translation>
  </message>
  <message>
   <source>The script {0} does not exist.</source>
   <translation>Das Skript {0} gibt es nicht.</translation>
  </message>
  <message>
   <source>The sensor looked over it: there is air above</source>
   <translation>Der Sensor sah darüber hinweg: Oben ist Luft</translation>
  </message>
  <message>
   <source>The sensor went through it</source>
   <translation>Der Sensor ging hindurch</translation>
  </message>
  <message>
   <source>The sensor {0} is taken to sit at {1}: no transform says otherwise.</source>
   <translation>Der Sensor {0} wird bei {1} angenommen: Keine Transformation sagt etwas anderes.</translation>
  </message>
  <message>
   <source>The share of wall for a passage.</source>
   <translation>Der Wandanteil für einen Durchgang.</translation>
  </message>
  <message>
   <source>The slice of the voxel map that gives the universe F_h.</source>
   <translation>Der Schnitt der Voxelkarte, der die Grundmenge F_h gibt.</translation>
  </message>
  <message>
   <source>The storey that is shown; each keeps its own corrections and checks.</source>
   <translation>Das gezeigte Geschoss; jedes behält seine eigenen Korrekturen und Kontrollmaße.</translation>
  </message>
  <message>
   <source>The survey is larger than memory, and no temporary file of {0} MB can be made in {1} ({2}); set TMPDIR to a folder on a disk.</source>
   <translation>Die Aufnahme ist größer als der Speicher, und in {1} lässt sich keine temporäre Datei von {0} MB anlegen ({2}); TMPDIR auf einen Ordner eines Datenträgers setzen.</translation>
  </message>
  <message>
   <source>The survey is larger than memory, and {0} has no room for a temporary file of {1} MB; free space there, set TMPDIR to a folder on a larger disk, or enlarge voxels.size.</source>
   <translation>Die Aufnahme ist größer als der Speicher, und {0} hat keinen Platz für eine temporäre Datei von {1} MB; dort Platz schaffen, TMPDIR auf einen Ordner eines größeren Datenträgers setzen oder voxels.size vergrößern.</translation>
  </message>
  <message>
   <source>The survey was not read yet.</source>
   <translation>Die Aufnahme wurde noch nicht gelesen.</translation>
  </message>
  <message>
   <source>The time stamps of {0} go back {1} times, first after row {2}; rows are used in the order of the file.</source>
   <translation>Die Zeitstempel von {0} springen {1}-mal zurück, zuerst nach Zeile {2}; die Zeilen gelten in der Reihenfolge der Datei.</translation>
  </message>
  <message>
   <source>The timeline large.</source>
   <translation>Die Zeitleiste groß.</translation>
  </message>
  <message>
   <source>The times of {0} ({1} to {2} s) and of the trajectory ({3} to {4} s) do not meet; give the trajectory of this survey.</source>
   <translation>Die Zeiten von {0} ({1} bis {2} s) und der Trajektorie ({3} bis {4} s) treffen sich nicht; die Trajektorie dieser Aufnahme angeben.</translation>
  </message>
  <message>
   <source>The topic {0} of {1} cannot be read too: {2}.</source>
   <translation>Das Topic {0} von {1} kann nicht mitgelesen werden: {2}.</translation>
  </message>
  <message>
   <source>The topic {0} of {1} holds no messages.</source>
   <translation>Das Topic {0} von {1} enthält keine Nachrichten.</translation>
  </message>
  <message>
   <source>The topic {0} places the scans.</source>
   <translation>Das Topic {0} gibt den Scans ihre Lage.</translation>
  </message>
  <message>
   <source>The trajectory is in metres, unlike the points.</source>
   <translation>Die Trajektorie ist in Metern, anders als die Punkte.</translation>
  </message>
  <message>
   <source>The trajectory is not of the survey {0}: half of the points are more than {1} m from the sensor that it gives them (the maximum range is {2} m); give the right one.</source>
   <translation>Die Trajektorie gehört nicht zur Aufnahme {0}: Die Hälfte der Punkte liegt weiter als {1} m vom Sensor, den sie ihnen gibt (die größte Reichweite ist {2} m); die richtige angeben.</translation>
  </message>
  <message>
   <source>The trajectory is not of the survey {0}: {1} of its positions lie more than {2} m outside the points; give the right one with --trajectory.</source>
   <translation>Die Trajektorie gehört nicht zur Aufnahme {0}: {1} ihrer Lagen liegen mehr als {2} m außerhalb der Punkte; mit --trajectory die richtige angeben.</translation>
  </message>
  <message>
   <source>The trajectory is not of the survey {0}: {1} of the points lie behind walls, seen from the sensor that it gives them; give the right one with --trajectory.</source>
   <translation>Die Trajektorie gehört nicht zur Aufnahme {0}: {1} der Punkte liegen hinter Wänden, gesehen vom Sensor, den sie ihnen gibt; mit --trajectory die richtige angeben.</translation>
  </message>
  <message>
   <source>The trajectory is {0}, found beside {1}.</source>
   <translation>Die Trajektorie ist {0}, neben {1} gefunden.</translation>
  </message>
  <message>
   <source>The trajectory is {0}.</source>
   <translation>Die Trajektorie ist {0}.</translation>
  </message>
  <message>
   <source>The trajectory was corrected by up to {0} m and {1} degrees: {2} planes explain {3} sightings of walls, floors and ceilings.</source>
   <translation>Die Trajektorie wurde um bis zu {0} m und {1} Grad korrigiert: {2} Ebenen erklären {3} Sichtungen von Wänden, Böden und Decken.</translation>
  </message>
  <message>
   <source>The trajectory {0} does not exist.</source>
   <translation>Die Trajektorie {0} gibt es nicht.</translation>
  </message>
  <message>
   <source>The trajectory {0} holds a pose that is no rotation with a position.</source>
   <translation>Die Trajektorie {0} enthält eine Pose, die keine Drehung mit einer Lage ist.</translation>
  </message>
  <message>
   <source>The trajectory {0} holds no poses.</source>
   <translation>Die Trajektorie {0} enthält keine Posen.</translation>
  </message>
  <message>
   <source>The trajectory {0} is not in the form of Open3D.</source>
   <translation>Die Trajektorie {0} hat nicht die Form von Open3D.</translation>
  </message>
  <message>
   <source>The trajectory's clock is {0}, {1} s from that of {2}.</source>
   <translation>Die Uhr der Trajektorie ist {0}, {1} s neben der von {2}.</translation>
  </message>
  <message>
   <source>The two points of a measurement are the same; give two different ones.</source>
   <translation>Die beiden Punkte einer Messung sind gleich; bitte zwei verschiedene angeben.</translation>
  </message>
  <message>
   <source>The viewpoint of {0} is taken as its sensor's origin.</source>
   <translation>Der Standpunkt (VIEWPOINT) von {0} gilt als Ursprung des Sensors.</translation>
  </message>
  <message>
   <source>The wall added at {0} is too short for one.</source>
   <translation>Die bei {0} hinzugefügte Wand ist zu kurz für eine Wand.</translation>
  </message>
  <message>
   <source>The wall ends freely on both sides of it</source>
   <translation>Die Wand endet beiderseits frei</translation>
  </message>
  <message>
   <source>The wall moved from {0} is not there any more.</source>
   <translation>Die von {0} verschobene Wand ist nicht mehr da.</translation>
  </message>
  <message>
   <source>The {0} {1} is {2}, not a file.</source>
   <translation>Die {0} {1} ist {2}, keine Datei.</translation>
  </message>
  <message>
   <source>Theme</source>
   <translation>Farben</translation>
  </message>
  <message>
   <source>There is a region {0} already.</source>
   <translation>Es gibt schon eine Region {0}.</translation>
  </message>
  <message>
   <source>There is no action {0}; the actions are: {1}.</source>
   <translation>Es gibt keinen Befehl {0}; die Befehle sind: {1}.</translation>
  </message>
  <message>
   <source>There is no dialog {0}.</source>
   <translation>Es gibt keinen Dialog {0}.</translation>
  </message>
  <message>
   <source>There is no display to open a window on; 'floorcast gui --script FILE' needs none.</source>
   <translation>Es gibt keinen Bildschirm für ein Fenster; „floorcast gui --script DATEI“ braucht keinen.</translation>
  </message>
  <message>
   <source>There is no exporter {0}; known: {1}.</source>
   <translation>Es gibt kein Exportformat {0}; bekannt sind: {1}.</translation>
  </message>
  <message>
   <source>There is no layer {0}; the layers are: {1}.</source>
   <translation>Es gibt keinen Layer {0}; die Layer sind: {1}.</translation>
  </message>
  <message>
   <source>There is no measurement {0}; the measurements are: {1}.</source>
   <translation>Es gibt keine Messung {0}; die Messungen sind: {1}.</translation>
  </message>
  <message>
   <source>There is no pane {0}; the panes are: {1}.</source>
   <translation>Es gibt keine Ansicht {0}; die Ansichten sind: {1}.</translation>
  </message>
  <message>
   <source>There is no plan to show in Open3D yet; open a survey first.</source>
   <translation>Es gibt noch keinen Plan für Open3D; bitte zuerst eine Aufnahme öffnen.</translation>
  </message>
  <message>
   <source>There is no plan yet.</source>
   <translation>Es gibt noch keinen Plan.</translation>
  </message>
  <message>
   <source>There is no preference {0}; there are: {1}.</source>
   <translation>Es gibt keine Voreinstellung {0}; es gibt: {1}.</translation>
  </message>
  <message>
   <source>There is no region classifier {0} (setting labels.classifier); known: {1}.</source>
   <translation>Es gibt keine Einordnung {0} der Regionen (Einstellung labels.classifier); bekannt sind: {1}.</translation>
  </message>
  <message>
   <source>There is no setting {0}; 'floorcast settings' lists them.</source>
   <translation>Es gibt keine Einstellung {0}; „floorcast settings“ nennt alle.</translation>
  </message>
  <message>
   <source>There is no step {0}: the history has the steps 0 to {1}.</source>
   <translation>Es gibt keinen Schritt {0}: Der Verlauf hat die Schritte 0 bis {1}.</translation>
  </message>
  <message>
   <source>There is no storey {0} in {1}: {2}.</source>
   <translation>Es gibt kein Geschoss {0} in {1}: {2}.</translation>
  </message>
  <message>
   <source>There is no storey {0}; the survey has storeys 0 to {1}.</source>
   <translation>Es gibt kein Geschoss {0}; die Aufnahme hat die Geschosse 0 bis {1}.</translation>
  </message>
  <message>
   <source>There is no survey to look for.</source>
   <translation>Es gibt keine Aufnahme zu suchen.</translation>
  </message>
  <message>
   <source>There is no {0} {1} in this plan.</source>
   <translation>Es gibt kein {0} {1} in diesem Plan.</translation>
  </message>
  <message>
   <source>There is no {0} {1}.</source>
   <translation>Es gibt kein {0} {1}.</translation>
  </message>
  <message>
   <source>These stages were kept by another version; run again with --save-stages.</source>
   <translation>Diese Stufen hat eine andere Version aufgehoben; noch einmal mit --save-stages starten.</translation>
  </message>
  <message>
   <source>Thickness between its two faces</source>
   <translation>Dicke zwischen ihren beiden Seiten</translation>
  </message>
  <message>
   <source>This format has metres and English words for every reader.</source>
   <translation>Dieses Format hat für alle Leser Meter und englische Wörter.</translation>
  </message>
  <message>
   <source>This is no Manhattan world: only {0} of the wall surface is within {1} degrees of two perpendicular directions (frame.min_support is {2}); if the building has walls at other angles, lower it.</source>
   <translation>Dies ist keine Manhattan-Welt: Nur {0} der Wandfläche liegt innerhalb von {1} Grad um zwei senkrechte Richtungen (frame.min_support ist {2}); hat das Gebäude Wände unter anderen Winkeln, diesen Wert senken.</translation>
  </message>
  <message>
   <source>This survey does not say when its points were measured.</source>
   <translation>Diese Aufnahme sagt nicht, wann ihre Punkte gemessen wurden.</translation>
  </message>
  <message>
   <source>This survey holds no colour: points by height</source>
   <translation>Diese Aufnahme hat keine Farben: Punkte nach Höhe</translation>
  </message>
  <message>
   <source>This survey holds no intensity: points by height</source>
   <translation>Diese Aufnahme hat keine Intensität: Punkte nach Höhe</translation>
  </message>
  <message>
   <source>This version of Floorcast has no setting {0}; the project goes on without.</source>
   <translation>Diese Version von Floorcast hat keine Einstellung {0}; das Projekt geht ohne sie weiter.</translation>
  </message>
  <message>
   <source>Time</source>
   <translation>Zeit</translation>
  </message>
  <message>
   <source>Time limit</source>
   <translation>Zeitgrenze</translation>
  </message>
  <message>
   <source>Timeline</source>
   <translation>Zeitleiste</translation>
  </message>
  <message>
   <source>Title</source>
   <translation>Titel</translation>
  </message>
  <message>
   <source>To</source>
   <translation>Bis</translation>
  </message>
  <message>
   <source>To the inside faces of the walls</source>
   <translation>Bis zu den Innenseiten der Wände</translation>
  </message>
  <message>
   <source>To the unit square: a corridor where it is over the limit</source>
   <translation>Zum Einheitsquadrat: ein Flur, wo er über der Grenze liegt</translation>
  </message>
  <message>
   <source>Tolerance</source>
   <translation>Toleranz</translation>
  </message>
  <message>
   <source>Too little of its height was seen</source>
   <translation>Von seiner Höhe ist zu wenig zu sehen</translation>
  </message>
  <message>
   <source>Too little to make a plan of: {0} points in {1} voxels of {2} m; check the unit (--set input.unit=...) or give more scans.</source>
   <translation>Zu wenig für einen Plan: {0} Punkte in {1} Voxeln von {2} m; Einheit prüfen (--set input.unit=...) oder mehr Scans geben.</translation>
  </message>
  <message>
   <source>Toolbar</source>
   <translation>Werkzeugleiste</translation>
  </message>
  <message>
   <source>Tools</source>
   <translation>Werkzeuge</translation>
  </message>
  <message>
   <source>Top</source>
   <translation>Oben</translation>
  </message>
  <message>
   <source>Topic</source>
   <translation>Topic</translation>
  </message>
  <message>
   <source>Topics of a ROS recording that hold the scans, with commas between; empty: the clouds of all sensors, else their planar scans, else their depth images.</source>
   <translation>Topics einer ROS-Aufzeichnung mit den Scans, durch Kommas getrennt; leer: die Punktwolken aller Sensoren, sonst ihre ebenen Scans, sonst ihre Tiefenbilder.</translation>
  </message>
  <message>
   <source>Trajectory</source>
   <translation>Weg</translation>
  </message>
  <message>
   <source>Transforms join the frame {0} to {1}.</source>
   <translation>Transformationen verbinden das System {0} mit {1}.</translation>
  </message>
  <message>
   <source>Transforms place the frame {0} in {1}.</source>
   <translation>Transformationen geben die Lage des Systems {0} in {1} an.</translation>
  </message>
  <message>
   <source>Tripod scanner, precise</source>
   <translation>Standscanner, genau</translation>
  </message>
  <message>
   <source>Try Floorcast on a survey that comes with it.</source>
   <translation>Floorcast an einer mitgelieferten Aufnahme ausprobieren.</translation>
  </message>
  <message>
   <source>Try the bundled survey</source>
   <translation>Mitgelieferte Aufnahme</translation>
  </message>
  <message>
   <source>Turn of the walls against the file's axes</source>
   <translation>Drehung der Wände gegen die Achsen der Datei</translation>
  </message>
  <message>
   <source>Turned</source>
   <translation>Gedreht</translation>
  </message>
  <message>
   <source>Turning</source>
   <translation>Drehabstand</translation>
  </message>
  <message>
   <source>Turning distance</source>
   <translation>Drehabstand</translation>
  </message>
  <message>
   <source>Turning distance to the unit square: how little it is like a room</source>
   <translation>Drehabstand zum Einheitsquadrat: wie wenig sie einem Raum gleicht</translation>
  </message>
  <message>
   <source>Two clicks across a region cut it in two.</source>
   <translation>Zwei Klicks quer durch eine Region teilen sie.</translation>
  </message>
  <message>
   <source>Two clicks draw a wall with two faces.</source>
   <translation>Zwei Klicks zeichnen eine Wand mit zwei Seiten.</translation>
  </message>
  <message>
   <source>Two clicks measure a distance, from wall to wall where both are walls; A measures an area.</source>
   <translation>Zwei Klicks messen einen Abstand, von Wand zu Wand, wo beides Wände sind; A misst eine Fläche.</translation>
  </message>
  <message>
   <source>Two clicks on a wall add a door; drag the ends of the selected one.</source>
   <translation>Zwei Klicks auf eine Wand fügen eine Tür hinzu; die Enden der gewählten lassen sich ziehen.</translation>
  </message>
  <message>
   <source>Two clicks on a wall, one at each jamb.</source>
   <translation>Zwei Klicks auf eine Wand, einer an jeder Laibung.</translation>
  </message>
  <message>
   <source>Two clicks: the region between them is cut from side to side.</source>
   <translation>Zwei Klicks: Die Region dazwischen wird von Seite zu Seite geteilt.</translation>
  </message>
  <message>
   <source>Two faces farther apart than this are not one wall.</source>
   <translation>Zwei Seiten, die weiter auseinander liegen, sind nicht eine Wand.</translation>
  </message>
  <message>
   <source>Type a command or a setting</source>
   <translation>Befehl oder Einstellung eingeben</translation>
  </message>
  <message>
   <source>Type some letters of a command or a setting, press Enter.</source>
   <translation>Einige Buchstaben eines Befehls oder einer Einstellung eingeben, dann Enter.</translation>
  </message>
  <message>
   <source>Type the width of the opening; or drag its ends in a plan.</source>
   <translation>Die Breite der Öffnung eingeben; oder ihre Enden im Plan ziehen.</translation>
  </message>
  <message>
   <source>Type where it lies; or drag it in a plan, where it snaps to what was seen.</source>
   <translation>Eingeben, wo sie liegt; oder im Plan ziehen, wo sie an Gesehenem einrastet.</translation>
  </message>
  <message>
   <source>US survey feet</source>
   <translation>US-Vermessungsfuß</translation>
  </message>
  <message>
   <source>Undo</source>
   <translation>Rückgängig</translation>
  </message>
  <message>
   <source>Unit</source>
   <translation>Einheit</translation>
  </message>
  <message>
   <source>Unit as guessed</source>
   <translation>Einheit wie vermutet</translation>
  </message>
  <message>
   <source>Unit of the file's coordinates; us-ft is the US survey foot.</source>
   <translation>Einheit der Koordinaten der Datei; us-ft ist der US-Vermessungsfuß.</translation>
  </message>
  <message>
   <source>Units</source>
   <translation>Einheiten</translation>
  </message>
  <message>
   <source>Unix time</source>
   <translation>Unix-Zeit</translation>
  </message>
  <message>
   <source>Unix time, from GPS time</source>
   <translation>Unix-Zeit, aus der GPS-Zeit</translation>
  </message>
  <message>
   <source>Unseen stretches between two seen parts of one wall are wall up to this length.</source>
   <translation>Ungesehene Stücke zwischen zwei gesehenen Teilen einer Wand sind bis zu dieser Länge Wand.</translation>
  </message>
  <message>
   <source>Up</source>
   <translation>Hochachse</translation>
  </message>
  <message>
   <source>Up axis as guessed</source>
   <translation>Hochachse wie vermutet</translation>
  </message>
  <message>
   <source>Use</source>
   <translation>Nehmen</translation>
  </message>
  <message>
   <source>Use a preset…</source>
   <translation>Vorgabe nehmen…</translation>
  </message>
  <message>
   <source>Use {0}</source>
   <translation>{0} nehmen</translation>
  </message>
  <message>
   <source>Version</source>
   <translation>Version</translation>
  </message>
  <message>
   <source>Version and licences.</source>
   <translation>Version und Lizenzen.</translation>
  </message>
  <message>
   <source>Version {version} · Apache License 2.0</source>
   <translation>Version {version} · Apache-Lizenz 2.0</translation>
  </message>
  <message>
   <source>View</source>
   <translation>Ansicht</translation>
  </message>
  <message>
   <source>Voxel map and surfels.</source>
   <translation>Voxelkarte und Surfel.</translation>
  </message>
  <message>
   <source>Voxels</source>
   <translation>Voxel</translation>
  </message>
  <message>
   <source>W</source>
   <translation>W</translation>
  </message>
  <message>
   <source>Wall</source>
   <translation>Wand</translation>
  </message>
  <message>
   <source>Wall depth</source>
   <translation>Wandtiefe</translation>
  </message>
  <message>
   <source>Wall support</source>
   <translation>Wandstützung</translation>
  </message>
  <message>
   <source>Wall was seen above it</source>
   <translation>Darüber wurde Wand gesehen</translation>
  </message>
  <message>
   <source>Wall was seen on both sides of it</source>
   <translation>Auf beiden Seiten wurde Wand gesehen</translation>
  </message>
  <message>
   <source>Wall was seen on one side of it, the other is a corner</source>
   <translation>Auf einer Seite wurde Wand gesehen, die andere ist eine Ecke</translation>
  </message>
  <message>
   <source>Wall {name}, faces {facing}</source>
   <translation>Wand {name}, weist nach {facing}</translation>
  </message>
  <message>
   <source>Walls and doors this near to a side do not lie in the interior.</source>
   <translation>Wände und Türen, die einer Seite so nahe sind, liegen nicht im Inneren.</translation>
  </message>
  <message>
   <source>Walls of a hand-held depth camera scatter by centimetres and bend; wider tolerances keep one wall one plane.</source>
   <translation>Wände aus einer handgeführten Tiefenkamera streuen um Zentimeter und biegen sich; weitere Toleranzen halten eine Wand in einer Ebene.</translation>
  </message>
  <message>
   <source>Walls of more observed surface than this never lie inside a region.</source>
   <translation>Wände mit mehr gesehener Fläche liegen nie im Inneren einer Region.</translation>
  </message>
  <message>
   <source>Warnings</source>
   <translation>Warnungen</translation>
  </message>
  <message>
   <source>Warnings ({n})</source>
   <translation>Warnungen ({n})</translation>
  </message>
  <message>
   <source>Weighted set cover of the free space.</source>
   <translation>Gewichtete Überdeckung des Freiraums.</translation>
  </message>
  <message>
   <source>What can be done with it</source>
   <translation>Was sich damit tun lässt</translation>
  </message>
  <message>
   <source>What it is</source>
   <translation>Was es ist</translation>
  </message>
  <message>
   <source>What it is made of</source>
   <translation>Woraus sie besteht</translation>
  </message>
  <message>
   <source>What the laser meter said.</source>
   <translation>Was das Lasermessgerät sagte.</translation>
  </message>
  <message>
   <source>What the laser meter said: double-click and type, like 3.2, 320 cm or 10' 6"</source>
   <translation>Was das Lasermessgerät sagte: doppelklicken und eingeben, etwa 3,2 oder 320 cm oder 10' 6"</translation>
  </message>
  <message>
   <source>What the map of a survey may take in memory; more goes to temporary files, and the plan stays the same. None: half of what is free, and no more than 1000.</source>
   <translation>Was die Karte einer Aufnahme im Arbeitsspeicher belegen darf; mehr kommt in temporäre Dateien, und der Plan bleibt derselbe. Keine Angabe: die Hälfte dessen, was frei ist, und nicht mehr als 1000.</translation>
  </message>
  <message>
   <source>What the map of a survey may take, of surveys opened from now on; more goes to temporary files.</source>
   <translation>Was die Karte einer Aufnahme belegen darf, die ab jetzt geöffnet wird; was darüber ist, kommt in temporäre Dateien.</translation>
  </message>
  <message>
   <source>What the points are coloured by</source>
   <translation>Wonach die Punkte gefärbt sind</translation>
  </message>
  <message>
   <source>What was said by hand, and what the machine had said</source>
   <translation>Was von Hand gesagt wurde, und was das Programm gesagt hatte</translation>
  </message>
  <message>
   <source>Wheel</source>
   <translation>Mausrad</translation>
  </message>
  <message>
   <source>Where is {0}?</source>
   <translation>Wo ist {0}?</translation>
  </message>
  <message>
   <source>Whole survey</source>
   <translation>Ganze Aufnahme</translation>
  </message>
  <message>
   <source>Whole window</source>
   <translation>Ganzes Fenster</translation>
  </message>
  <message>
   <source>Why it is there</source>
   <translation>Warum es da ist</translation>
  </message>
  <message>
   <source>Wider openings are no doors but openings (paper: 1.2 m).</source>
   <translation>Breitere Öffnungen sind keine Türen, sondern Öffnungen (Artikel: 1,2 m).</translation>
  </message>
  <message>
   <source>Widest aperture that is taken for a door.</source>
   <translation>Breiteste Öffnung, die als Tür gilt.</translation>
  </message>
  <message>
   <source>Widest gap in a wall that still parts two rooms.</source>
   <translation>Breiteste Lücke in einer Wand, die noch zwei Räume trennt.</translation>
  </message>
  <message>
   <source>Widest opening below a lintel that still separates two regions.</source>
   <translation>Breiteste Öffnung unter einem Sturz, die noch zwei Regionen trennt.</translation>
  </message>
  <message>
   <source>Width</source>
   <translation>Breite</translation>
  </message>
  <message>
   <source>Width of a histogram bin.</source>
   <translation>Breite einer Klasse des Histogramms.</translation>
  </message>
  <message>
   <source>Width that the filter is matched to (paper: 1 m).</source>
   <translation>Breite, an die das Filter angepasst ist (Artikel: 1 m).</translation>
  </message>
  <message>
   <source>Window</source>
   <translation>Fenster</translation>
  </message>
  <message>
   <source>Wings</source>
   <translation>Flügel</translation>
  </message>
  <message>
   <source>Worst side</source>
   <translation>Schlechteste Seite</translation>
  </message>
  <message>
   <source>Write the plan as SVG, GeoJSON, PNG or another format.</source>
   <translation>Den Plan als SVG, GeoJSON, PNG oder in anderem Format schreiben.</translation>
  </message>
  <message>
   <source>Write what was done as a list of actions that 'floorcast gui --script' runs again.</source>
   <translation>Schreiben, was getan wurde, als Liste von Befehlen, die „floorcast gui --script“ wieder ausführt.</translation>
  </message>
  <message>
   <source>Wrote {0}.</source>
   <translation>{0} geschrieben.</translation>
  </message>
  <message>
   <source>Wrote {0}; run it with: floorcast gui --script {1}</source>
   <translation>{0} geschrieben; ausführen mit: floorcast gui --script {1}</translation>
  </message>
  <message>
   <source>Wrote {name}.</source>
   <translation>{name} geschrieben.</translation>
  </message>
  <message>
   <source>Yaw</source>
   <translation>Drehung</translation>
  </message>
  <message>
   <source>Yaw step</source>
   <translation>Schritt der Drehung</translation>
  </message>
  <message>
   <source>Zoom to it</source>
   <translation>Heranholen</translation>
  </message>
  <message>
   <source>Zoom to selection</source>
   <translation>Auswahl heranholen</translation>
  </message>
  <message>
   <source>Zoom to the pointer</source>
   <translation>Zoomt zum Zeiger</translation>
  </message>
  <message>
   <source>a 7-Zip archive; unpack it first</source>
   <translation>ein 7-Zip-Archiv; zuerst entpacken</translation>
  </message>
  <message>
   <source>a BMP picture, not a point cloud</source>
   <translation>ein BMP-Bild, keine Punktwolke</translation>
  </message>
  <message>
   <source>a DWG drawing, not a point cloud</source>
   <translation>eine DWG-Zeichnung, keine Punktwolke</translation>
  </message>
  <message>
   <source>a DXF drawing, not a point cloud</source>
   <translation>eine DXF-Zeichnung, keine Punktwolke</translation>
  </message>
  <message>
   <source>a GIF picture, not a point cloud</source>
   <translation>ein GIF-Bild, keine Punktwolke</translation>
  </message>
  <message>
   <source>a JPEG picture, not a point cloud</source>
   <translation>ein JPEG-Bild, keine Punktwolke</translation>
  </message>
  <message>
   <source>a JSON document, not a point cloud</source>
   <translation>ein JSON-Dokument, keine Punktwolke</translation>
  </message>
  <message>
   <source>a LAS or LAZ file, for which no reader is installed</source>
   <translation>eine LAS- oder LAZ-Datei, für die kein Leser installiert ist</translation>
  </message>
  <message>
   <source>a PDF document, not a point cloud</source>
   <translation>ein PDF-Dokument, keine Punktwolke</translation>
  </message>
  <message>
   <source>a PNG picture, not a point cloud</source>
   <translation>ein PNG-Bild, keine Punktwolke</translation>
  </message>
  <message>
   <source>a RAR archive; unpack it first</source>
   <translation>ein RAR-Archiv; zuerst entpacken</translation>
  </message>
  <message>
   <source>a ROS bag, for which no reader is installed</source>
   <translation>ein ROS-Bag, für das kein Leser installiert ist</translation>
  </message>
  <message>
   <source>a STEP or IFC model: a truth for the command evaluate, not a survey</source>
   <translation>ein STEP- oder IFC-Modell: eine Wahrheit für den Befehl evaluate, keine Aufnahme</translation>
  </message>
  <message>
   <source>a TIFF picture, not a point cloud</source>
   <translation>ein TIFF-Bild, keine Punktwolke</translation>
  </message>
  <message>
   <source>a VTK file; export it as PLY or PCD</source>
   <translation>eine VTK-Datei; als PLY oder PCD exportieren</translation>
  </message>
  <message>
   <source>a ZIP archive without arrays of points; unpack it first</source>
   <translation>ein ZIP-Archiv ohne Felder von Punkten; zuerst entpacken</translation>
  </message>
  <message>
   <source>a Zstandard archive; unpack it first</source>
   <translation>ein Zstandard-Archiv; zuerst entpacken</translation>
  </message>
  <message>
   <source>a bzip2 archive; unpack it first</source>
   <translation>ein bzip2-Archiv; zuerst entpacken</translation>
  </message>
  <message>
   <source>a check is damaged</source>
   <translation>ein Kontrollmaß ist beschädigt</translation>
  </message>
  <message>
   <source>a cloud has no x, y and z, but {0}</source>
   <translation>eine Wolke hat kein x, y und z, sondern {0}</translation>
  </message>
  <message>
   <source>a cloud of {0} x {1} points does not fit its {2} bytes</source>
   <translation>eine Wolke von {0} x {1} Punkten passt nicht zu ihren {2} Bytes</translation>
  </message>
  <message>
   <source>a compressed chunk ends before its end</source>
   <translation>ein komprimierter Block endet vor seinem Ende</translation>
  </message>
  <message>
   <source>a depth image of {0} x {1} does not fit its {2} bytes</source>
   <translation>ein Tiefenbild von {0} x {1} passt nicht zu seinen {2} Bytes</translation>
  </message>
  <message>
   <source>a device</source>
   <translation>ein Gerät</translation>
  </message>
  <message>
   <source>a document or a project of another program; export its points as E57 or LAS</source>
   <translation>ein Dokument oder Projekt eines anderen Programms; dessen Punkte als E57 oder LAS exportieren</translation>
  </message>
  <message>
   <source>a folder</source>
   <translation>ein Ordner</translation>
  </message>
  <message>
   <source>a glTF scene, for which no reader is installed</source>
   <translation>eine glTF-Szene, für die kein Leser installiert ist</translation>
  </message>
  <message>
   <source>a gzip archive; unpack it first</source>
   <translation>ein gzip-Archiv; zuerst entpacken</translation>
  </message>
  <message>
   <source>a part of this path is a file, not a folder</source>
   <translation>ein Teil dieses Pfads ist eine Datei, kein Ordner</translation>
  </message>
  <message>
   <source>a path is damaged</source>
   <translation>ein Pfad ist beschädigt</translation>
  </message>
  <message>
   <source>a pickled Python object, which is refused because reading it could run code</source>
   <translation>ein Python-Objekt (pickle), das abgelehnt wird, weil sein Lesen Programmcode ausführen könnte</translation>
  </message>
  <message>
   <source>a pipe</source>
   <translation>eine Pipe</translation>
  </message>
  <message>
   <source>a place is two numbers</source>
   <translation>eine Ortsangabe besteht aus zwei Zahlen</translation>
  </message>
  <message>
   <source>a plugin</source>
   <translation>eine Erweiterung</translation>
  </message>
  <message>
   <source>a polygon of {0} vertices and area {1} has no turning function</source>
   <translation>ein Polygon von {0} Ecken und der Fläche {1} hat keine Drehfunktion</translation>
  </message>
  <message>
   <source>a pose is no rotation with a finite position</source>
   <translation>eine Pose ist keine Drehung mit einer endlichen Lage</translation>
  </message>
  <message>
   <source>a project of ReCap, whose format is not open; export it as E57 or PTS</source>
   <translation>ein ReCap-Projekt, dessen Format nicht offen ist; als E57 oder PTS exportieren</translation>
  </message>
  <message>
   <source>a raw scan of FARO, whose format is not open; export it as E57</source>
   <translation>ein roher FARO-Scan, dessen Format nicht offen ist; als E57 exportieren</translation>
  </message>
  <message>
   <source>a scan of ReCap, whose format is not open; export it as E57 or PTS</source>
   <translation>ein ReCap-Scan, dessen Format nicht offen ist; als E57 oder PTS exportieren</translation>
  </message>
  <message>
   <source>a socket</source>
   <translation>ein Socket</translation>
  </message>
  <message>
   <source>a storey is not a number from 0</source>
   <translation>ein Geschoss ist keine Zahl ab 0</translation>
  </message>
  <message>
   <source>a tar archive; unpack it first</source>
   <translation>ein tar-Archiv; zuerst entpacken</translation>
  </message>
  <message>
   <source>a text document with formats, not a point cloud; save it as plain text</source>
   <translation>ein formatiertes Textdokument, keine Punktwolke; als reinen Text speichern</translation>
  </message>
  <message>
   <source>a text is missing or too long</source>
   <translation>ein Text fehlt oder ist zu lang</translation>
  </message>
  <message>
   <source>a trajectory, not a point cloud; open the cloud and name this file with --trajectory</source>
   <translation>eine Trajektorie, keine Punktwolke; die Wolke öffnen und diese Datei mit --trajectory angeben</translation>
  </message>
  <message>
   <source>a triangle refers to corner {0} of {1}</source>
   <translation>ein Dreieck bezieht sich auf Ecke {0} von {1}</translation>
  </message>
  <message>
   <source>a web page (HTML), not a point cloud: the download probably failed</source>
   <translation>eine Webseite (HTML), keine Punktwolke: Das Herunterladen ist wohl misslungen</translation>
  </message>
  <message>
   <source>above furniture</source>
   <translation>höher als Möbel</translation>
  </message>
  <message>
   <source>an E57 file, for which no reader is installed</source>
   <translation>eine E57-Datei, für die kein Leser installiert ist</translation>
  </message>
  <message>
   <source>an FBX scene; export it as glTF, OBJ or PLY</source>
   <translation>eine FBX-Szene; als glTF, OBJ oder PLY exportieren</translation>
  </message>
  <message>
   <source>an HDF5 file; export its points as LAS, PLY or NPZ</source>
   <translation>eine HDF5-Datei; ihre Punkte als LAS, PLY oder NPZ exportieren</translation>
  </message>
  <message>
   <source>an MCAP recording, for which no reader is installed</source>
   <translation>eine MCAP-Aufzeichnung, für die kein Leser installiert ist</translation>
  </message>
  <message>
   <source>an OFF mesh, for which no reader is installed</source>
   <translation>ein OFF-Netz, für das kein Leser installiert ist</translation>
  </message>
  <message>
   <source>an OctoMap, for which no reader is installed</source>
   <translation>eine OctoMap, für die kein Leser installiert ist</translation>
  </message>
  <message>
   <source>an SQLite database (a ROS 2 bag perhaps), for which no reader is installed</source>
   <translation>eine SQLite-Datenbank (vielleicht ein ROS-2-Bag), für die kein Leser installiert ist</translation>
  </message>
  <message>
   <source>an STL mesh, for which no reader is installed</source>
   <translation>ein STL-Netz, für das kein Leser installiert ist</translation>
  </message>
  <message>
   <source>an SVG picture, not a point cloud</source>
   <translation>ein SVG-Bild, keine Punktwolke</translation>
  </message>
  <message>
   <source>an XML document, not a point cloud</source>
   <translation>ein XML-Dokument, keine Punktwolke</translation>
  </message>
  <message>
   <source>an empty ZIP archive</source>
   <translation>ein leeres ZIP-Archiv</translation>
  </message>
  <message>
   <source>an exporter</source>
   <translation>ein Exportformat</translation>
  </message>
  <message>
   <source>an xz archive; unpack it first</source>
   <translation>ein xz-Archiv; zuerst entpacken</translation>
  </message>
  <message>
   <source>and {0} more</source>
   <translation>und {0} weitere</translation>
  </message>
  <message>
   <source>and {n} more</source>
   <translation>und {n} weitere</translation>
  </message>
  <message>
   <source>as asked</source>
   <translation>wie verlangt</translation>
  </message>
  <message>
   <source>as {0} files have it</source>
   <translation>wie es {0}-Dateien haben</translation>
  </message>
  <message>
   <source>auto</source>
   <translation>automatisch</translation>
  </message>
  <message>
   <source>automatic</source>
   <translation>automatisch</translation>
  </message>
  <message>
   <source>beside a doorway</source>
   <translation>neben einer Türöffnung</translation>
  </message>
  <message>
   <source>both faces</source>
   <translation>beide Wandseiten</translation>
  </message>
  <message>
   <source>both wall ends</source>
   <translation>beide Wandenden</translation>
  </message>
  <message>
   <source>building {0}</source>
   <translation>Gebäude {0}</translation>
  </message>
  <message>
   <source>by hand</source>
   <translation>von Hand</translation>
  </message>
  <message>
   <source>called {0}</source>
   <translation>namens {0}</translation>
  </message>
  <message>
   <source>centimetres</source>
   <translation>Zentimeter</translation>
  </message>
  <message>
   <source>check</source>
   <translation>Messung</translation>
  </message>
  <message>
   <source>choosing units and language</source>
   <translation>sie Einheiten und Sprache wählte</translation>
  </message>
  <message>
   <source>comes as {value}</source>
   <translation>geliefert: {value}</translation>
  </message>
  <message>
   <source>correct {0}</source>
   <translation>{0} korrigieren</translation>
  </message>
  <message>
   <source>corridor</source>
   <translation>Flur</translation>
  </message>
  <message>
   <source>corridor opens into a hall</source>
   <translation>Flur mündet in eine Halle</translation>
  </message>
  <message>
   <source>corridor: long for its width, narrow, many doors, ways lead through it; else room</source>
   <translation>Flur: lang für seine Breite, schmal, viele Türen, Wege führen hindurch; sonst Raum</translation>
  </message>
  <message>
   <source>depth images</source>
   <translation>Tiefenbilder</translation>
  </message>
  <message>
   <source>depth.txt of {0} lists no images.</source>
   <translation>depth.txt von {0} führt keine Bilder auf.</translation>
  </message>
  <message>
   <source>does not exist</source>
   <translation>gibt es nicht</translation>
  </message>
  <message>
   <source>door</source>
   <translation>Tür</translation>
  </message>
  <message>
   <source>door {0}</source>
   <translation>Tür {0}</translation>
  </message>
  <message>
   <source>doors {0} and {1}</source>
   <translation>Türen {0} und {1}</translation>
  </message>
  <message>
   <source>each has a file with its pose</source>
   <translation>zu jedem gehört eine Datei mit seiner Pose</translation>
  </message>
  <message>
   <source>east</source>
   <translation>Osten</translation>
  </message>
  <message>
   <source>exact</source>
   <translation>exakt</translation>
  </message>
  <message>
   <source>feet</source>
   <translation>Fuß</translation>
  </message>
  <message>
   <source>floor to ceiling is then {0} m</source>
   <translation>vom Boden zur Decke sind es dann {0} m</translation>
  </message>
  <message>
   <source>floorcast project</source>
   <translation>Floorcast-Projekt</translation>
  </message>
  <message>
   <source>folder of {0} scans</source>
   <translation>Ordner von {0} Scans</translation>
  </message>
  <message>
   <source>for {0}</source>
   <translation>für {0}</translation>
  </message>
  <message>
   <source>frame {yaw} (support {share})</source>
   <translation>Achsen {yaw} (Stützung {share})</translation>
  </message>
  <message>
   <source>free passage</source>
   <translation>freier Durchgang</translation>
  </message>
  <message>
   <source>furniture</source>
   <translation>Möbel</translation>
  </message>
  <message>
   <source>greedy</source>
   <translation>gierig</translation>
  </message>
  <message>
   <source>greedy (paper) or exact (integer program, HiGHS).</source>
   <translation>gierig (Artikel) oder exakt (ganzzahliges Programm, HiGHS).</translation>
  </message>
  <message>
   <source>grid map</source>
   <translation>Rasterkarte</translation>
  </message>
  <message>
   <source>hardly seen</source>
   <translation>kaum gesehen</translation>
  </message>
  <message>
   <source>in line with a wall</source>
   <translation>in der Flucht einer Wand</translation>
  </message>
  <message>
   <source>input</source>
   <translation>Eingabe</translation>
  </message>
  <message>
   <source>is a link to something that does not exist</source>
   <translation>ist ein Verweis auf etwas, das es nicht gibt</translation>
  </message>
  <message>
   <source>it gave {0} where a word is wanted</source>
   <translation>sie gab {0}, wo ein Wort verlangt ist</translation>
  </message>
  <message>
   <source>it has no {0}</source>
   <translation>es hat kein {0}</translation>
  </message>
  <message>
   <source>it has none of the hooks</source>
   <translation>sie hat keine der Schnittstellen</translation>
  </message>
  <message>
   <source>it has one storey, 0</source>
   <translation>sie hat ein Geschoss, 0</translation>
  </message>
  <message>
   <source>it has other fields than it should</source>
   <translation>sie hat andere Felder als vorgesehen</translation>
  </message>
  <message>
   <source>it holds no usable points</source>
   <translation>sie enthält keine brauchbaren Punkte</translation>
  </message>
  <message>
   <source>it holds {0}</source>
   <translation>es enthält {0}</translation>
  </message>
  <message>
   <source>it is another kind of file</source>
   <translation>es ist eine andere Art von Datei</translation>
  </message>
  <message>
   <source>it is larger than {0} bytes</source>
   <translation>sie ist größer als {0} Bytes</translation>
  </message>
  <message>
   <source>it is nested too deeply</source>
   <translation>sie ist zu tief verschachtelt</translation>
  </message>
  <message>
   <source>it refers to parts of itself (*name), which is refused</source>
   <translation>sie verweist auf Teile von sich selbst (*name), was abgelehnt wird</translation>
  </message>
  <message>
   <source>it sees what {0} does</source>
   <translation>es sieht dasselbe wie {0}</translation>
  </message>
  <message>
   <source>it wrote no file</source>
   <translation>sie schrieb keine Datei</translation>
  </message>
  <message>
   <source>its checks are not a list</source>
   <translation>seine Kontrollmaße sind keine Liste</translation>
  </message>
  <message>
   <source>its frame {0} is that of {1}</source>
   <translation>sein System {0} ist das von {1}</translation>
  </message>
  <message>
   <source>its frame {0} is the robot's, not a sensor's</source>
   <translation>sein System {0} ist das des Roboters, nicht das eines Sensors</translation>
  </message>
  <message>
   <source>its image is no name of a file</source>
   <translation>ihr Bild ist kein Dateiname</translation>
  </message>
  <message>
   <source>its list of places is damaged</source>
   <translation>ihre Liste von Orten ist beschädigt</translation>
  </message>
  <message>
   <source>its names of regions are damaged</source>
   <translation>seine Namen von Regionen sind beschädigt</translation>
  </message>
  <message>
   <source>its settings are damaged</source>
   <translation>seine Einstellungen sind beschädigt</translation>
  </message>
  <message>
   <source>its storeys are 0 to {0}</source>
   <translation>ihre Geschosse sind 0 bis {0}</translation>
  </message>
  <message>
   <source>its storeys are not a list</source>
   <translation>seine Geschosse sind keine Liste</translation>
  </message>
  <message>
   <source>its survey is damaged</source>
   <translation>seine Aufnahme ist beschädigt</translation>
  </message>
  <message>
   <source>its version is {0}, this program reads {1}</source>
   <translation>seine Version ist {0}, dieses Programm liest {1}</translation>
  </message>
  <message>
   <source>its view is not a table</source>
   <translation>seine Ansicht ist keine Tabelle</translation>
  </message>
  <message>
   <source>label {0}</source>
   <translation>Art {0}</translation>
  </message>
  <message>
   <source>labelling region {0}</source>
   <translation>sie Region {0} einordnete</translation>
  </message>
  <message>
   <source>long, top not seen</source>
   <translation>lang, oberes Ende nicht gesehen</translation>
  </message>
  <message>
   <source>looked over</source>
   <translation>darüber hinweggesehen</translation>
  </message>
  <message>
   <source>looking at {0}</source>
   <translation>sie {0} ansah</translation>
  </message>
  <message>
   <source>mcap recover</source>
   <translation>mcap recover</translation>
  </message>
  <message>
   <source>metres</source>
   <translation>Meter</translation>
  </message>
  <message>
   <source>millimetres</source>
   <translation>Millimeter</translation>
  </message>
  <message>
   <source>mostly predicted</source>
   <translation>meist vorhergesagt</translation>
  </message>
  <message>
   <source>name {0}</source>
   <translation>Name {0}</translation>
  </message>
  <message>
   <source>narrow between two spaces</source>
   <translation>schmale Stelle zwischen zwei Räumen</translation>
  </message>
  <message>
   <source>no plan yet</source>
   <translation>noch kein Plan</translation>
  </message>
  <message>
   <source>no properties</source>
   <translation>keine Eigenschaften</translation>
  </message>
  <message>
   <source>no transform joins its frame {0} to {1}</source>
   <translation>keine Transformation verbindet sein System {0} mit {1}</translation>
  </message>
  <message>
   <source>none</source>
   <translation>keine</translation>
  </message>
  <message>
   <source>north</source>
   <translation>Norden</translation>
  </message>
  <message>
   <source>numbers without a header (a scan of KITTI?); name the folder of the scans, with its trajectory</source>
   <translation>Zahlen ohne Kopf (ein Scan von KITTI?); den Ordner der Scans angeben, mit seiner Trajektorie</translation>
  </message>
  <message>
   <source>numpy arrays: points (N, 3), (3, N) or (h, w, 3), or records with x, y and z; optional scan_id</source>
   <translation>numpy-Felder: Punkte (N, 3), (3, N) oder (h, w, 3), oder Datensätze mit x, y und z; scan_id, wenn vorhanden</translation>
  </message>
  <message>
   <source>one grey value for each region, on the raster of the grid map</source>
   <translation>ein Grauwert für jede Region, auf dem Raster der Rasterkarte</translation>
  </message>
  <message>
   <source>opening</source>
   <translation>Öffnung</translation>
  </message>
  <message>
   <source>other face of a wall</source>
   <translation>andere Seite einer Wand</translation>
  </message>
  <message>
   <source>path {length}</source>
   <translation>Weg {length}</translation>
  </message>
  <message>
   <source>permission denied; choose a folder that you may write to</source>
   <translation>Zugriff verweigert; einen Ordner wählen, in den geschrieben werden darf</translation>
  </message>
  <message>
   <source>predicted</source>
   <translation>vorhergesagt</translation>
  </message>
  <message>
   <source>predicted {area}</source>
   <translation>vorhergesagt {area}</translation>
  </message>
  <message>
   <source>reaches ceiling</source>
   <translation>reicht bis zur Decke</translation>
  </message>
  <message>
   <source>reading ahead</source>
   <translation>Vorauslesen</translation>
  </message>
  <message>
   <source>reading {0}</source>
   <translation>sie {0} las</translation>
  </message>
  <message>
   <source>ready in {time}</source>
   <translation>fertig in {time}</translation>
  </message>
  <message>
   <source>recess</source>
   <translation>Nische</translation>
  </message>
  <message>
   <source>region</source>
   <translation>Region</translation>
  </message>
  <message>
   <source>region {0}</source>
   <translation>Region {0}</translation>
  </message>
  <message>
   <source>regions {0} and {1}</source>
   <translation>Regionen {0} und {1}</translation>
  </message>
  <message>
   <source>rejected</source>
   <translation>verworfen</translation>
  </message>
  <message>
   <source>resized</source>
   <translation>in der Breite geändert</translation>
  </message>
  <message>
   <source>room</source>
   <translation>Raum</translation>
  </message>
  <message>
   <source>room: perimeter under 60 m and turning distance to the square under 1; else corridor</source>
   <translation>Raum: Umfang unter 60 m und Drehabstand zum Quadrat unter 1; sonst Flur</translation>
  </message>
  <message>
   <source>rosbag reindex</source>
   <translation>rosbag reindex</translation>
  </message>
  <message>
   <source>scan folder</source>
   <translation>Scanordner</translation>
  </message>
  <message>
   <source>seconds of the GPS week</source>
   <translation>Sekunden der GPS-Woche</translation>
  </message>
  <message>
   <source>seen</source>
   <translation>gesehen</translation>
  </message>
  <message>
   <source>seen {area}</source>
   <translation>gesehen {area}</translation>
  </message>
  <message>
   <source>something else</source>
   <translation>etwas anderes</translation>
  </message>
  <message>
   <source>south</source>
   <translation>Süden</translation>
  </message>
  <message>
   <source>straight boundary of free space</source>
   <translation>gerade Grenze des freien Raums</translation>
  </message>
  <message>
   <source>text in UTF-16; save it as UTF-8</source>
   <translation>Text in UTF-16; als UTF-8 speichern</translation>
  </message>
  <message>
   <source>the disk quota is used up; free some space, or choose another folder</source>
   <translation>das Kontingent auf dem Datenträger ist erschöpft; Platz schaffen oder einen anderen Ordner wählen</translation>
  </message>
  <message>
   <source>the disk reports an error</source>
   <translation>der Datenträger meldet einen Fehler</translation>
  </message>
  <message>
   <source>the file system is read-only; choose another folder</source>
   <translation>das Dateisystem ist schreibgeschützt; einen anderen Ordner wählen</translation>
  </message>
  <message>
   <source>the file would be larger than this system allows</source>
   <translation>die Datei würde größer, als dieses System zulässt</translation>
  </message>
  <message>
   <source>the header of a message is longer than the message</source>
   <translation>der Kopf einer Nachricht ist länger als die Nachricht</translation>
  </message>
  <message>
   <source>the height is then {0} m</source>
   <translation>die Höhe ist dann {0} m</translation>
  </message>
  <message>
   <source>the name is too long</source>
   <translation>der Name ist zu lang</translation>
  </message>
  <message>
   <source>the outline of a region is damaged</source>
   <translation>der Umriss einer Region ist beschädigt</translation>
  </message>
  <message>
   <source>the pointer of Git LFS to a file, not the file; get it with git lfs pull</source>
   <translation>der Verweis von Git LFS auf eine Datei, nicht die Datei; mit git lfs pull holen</translation>
  </message>
  <message>
   <source>the points are flat, so only their extent could tell</source>
   <translation>die Punkte sind flach, nur ihre Ausdehnung kann es sagen</translation>
  </message>
  <message>
   <source>the run</source>
   <translation>die Fahrt</translation>
  </message>
  <message>
   <source>the same where the floor is predicted, not seen; 0 elsewhere</source>
   <translation>dasselbe, wo Boden vorhergesagt und nicht gesehen ist; sonst 0</translation>
  </message>
  <message>
   <source>the survey</source>
   <translation>die Aufnahme</translation>
  </message>
  <message>
   <source>their poses are in {0}</source>
   <translation>ihre Posen stehen in {0}</translation>
  </message>
  <message>
   <source>there is a file of this name where a folder is wanted</source>
   <translation>wo ein Ordner hin soll, liegt eine Datei dieses Namens</translation>
  </message>
  <message>
   <source>there is a folder of this name where a file is wanted</source>
   <translation>wo eine Datei hin soll, liegt ein Ordner dieses Namens</translation>
  </message>
  <message>
   <source>there is no space left on the disk; free some, or choose another folder with --out</source>
   <translation>auf dem Datenträger ist kein Platz mehr; Platz schaffen oder mit --out einen anderen Ordner wählen</translation>
  </message>
  <message>
   <source>trajectory</source>
   <translation>Trajektorie</translation>
  </message>
  <message>
   <source>type it here</source>
   <translation>hier eingeben</translation>
  </message>
  <message>
   <source>user folder</source>
   <translation>Benutzerordner</translation>
  </message>
  <message>
   <source>wall</source>
   <translation>Wand</translation>
  </message>
  <message>
   <source>wall at {0}</source>
   <translation>Wand bei {0}</translation>
  </message>
  <message>
   <source>wall on both sides</source>
   <translation>Wand auf beiden Seiten</translation>
  </message>
  <message>
   <source>wall {0}</source>
   <translation>Wand {0}</translation>
  </message>
  <message>
   <source>walls {0} and {1}</source>
   <translation>Wände {0} und {1}</translation>
  </message>
  <message>
   <source>west</source>
   <translation>Westen</translation>
  </message>
  <message>
   <source>wing {0}</source>
   <translation>Gebäudeflügel {0}</translation>
  </message>
  <message>
   <source>worse than every LOA band</source>
   <translation>schlechter als jede LOA-Klasse</translation>
  </message>
  <message>
   <source>writing {0}</source>
   <translation>sie {0} schrieb</translation>
  </message>
  <message>
   <source>x from</source>
   <translation>x von</translation>
  </message>
  <message>
   <source>x to</source>
   <translation>x bis</translation>
  </message>
  <message>
   <source>y from</source>
   <translation>y von</translation>
  </message>
  <message>
   <source>y to</source>
   <translation>y bis</translation>
  </message>
  <message>
   <source>{0} ({1}) is not possible now.</source>
   <translation>{0} ({1}) ist jetzt nicht möglich.</translation>
  </message>
  <message>
   <source>{0} It was left out.</source>
   <translation>{0} Sie wurde weggelassen.</translation>
  </message>
  <message>
   <source>{0} The poses of its scans are not taken for the sensor's.</source>
   <translation>{0} Die Posen ihrer Scans gelten nicht als die des Sensors.</translation>
  </message>
  <message>
   <source>{0} and {1} are in different coordinate reference systems; bring them into one first.</source>
   <translation>{0} und {1} haben verschiedene Koordinatensysteme; zuerst in eines bringen.</translation>
  </message>
  <message>
   <source>{0} and {1} lie {2} km apart and are not of one survey; plan them one by one.</source>
   <translation>{0} und {1} liegen {2} km auseinander und gehören nicht zu einer Aufnahme; einzeln planen.</translation>
  </message>
  <message>
   <source>{0} and {1} more</source>
   <translation>{0} und {1} weitere</translation>
  </message>
  <message>
   <source>{0} announces {1} points; what its lines hold is what counts.</source>
   <translation>{0} kündigt {1} Punkte an; es zählt, was die Zeilen enthalten.</translation>
  </message>
  <message>
   <source>{0} became longer while it was read; wait until it is whole.</source>
   <translation>{0} wurde während des Lesens länger; warten, bis die Datei vollständig ist.</translation>
  </message>
  <message>
   <source>{0} became shorter while it was read; copy it whole and try again.</source>
   <translation>{0} wurde während des Lesens kürzer; vollständig kopieren und noch einmal versuchen.</translation>
  </message>
  <message>
   <source>{0} buildings stand apart from each other: each is planned by itself, in one frame.</source>
   <translation>{0} Gebäude stehen auseinander: Jedes wird für sich geplant, in einem Achsenkreuz.</translation>
  </message>
  <message>
   <source>{0} cannot be imported</source>
   <translation>{0} lässt sich nicht laden</translation>
  </message>
  <message>
   <source>{0} cannot be read as a picture: {1}.</source>
   <translation>{0} lässt sich nicht als Bild lesen: {1}.</translation>
  </message>
  <message>
   <source>{0} claims to be PCD but its header does not end (no DATA line).</source>
   <translation>{0} gibt sich als PCD aus, aber der Kopf endet nicht (keine Zeile DATA).</translation>
  </message>
  <message>
   <source>{0} claims to be PCD but its header has no {1} line.</source>
   <translation>{0} gibt sich als PCD aus, aber im Kopf fehlt die Zeile {1}.</translation>
  </message>
  <message>
   <source>{0} claims to be PCD but {1} in its header is not valid.</source>
   <translation>{0} gibt sich als PCD aus, aber {1} im Kopf ist nicht gültig.</translation>
  </message>
  <message>
   <source>{0} claims to be PLY but its element {1} has no properties.</source>
   <translation>{0} gibt sich als PLY aus, aber das Element {1} hat keine Eigenschaften.</translation>
  </message>
  <message>
   <source>{0} claims to be PLY but its header does not end ('end_header' is missing).</source>
   <translation>{0} gibt sich als PLY aus, aber der Kopf endet nicht ('end_header' fehlt).</translation>
  </message>
  <message>
   <source>{0} claims to be PLY but its header has no 'format' line.</source>
   <translation>{0} gibt sich als PLY aus, aber im Kopf fehlt die Zeile 'format'.</translation>
  </message>
  <message>
   <source>{0} claims to be PLY but line {1} of its header is not valid: {2}.</source>
   <translation>{0} gibt sich als PLY aus, aber Zeile {1} des Kopfes ist nicht gültig: {2}.</translation>
  </message>
  <message>
   <source>{0} claims to be an OctoMap but its header does not end with 'data'.</source>
   <translation>{0} gibt sich als OctoMap aus, aber der Kopf endet nicht mit 'data'.</translation>
  </message>
  <message>
   <source>{0} claims to be {1} but its content is not; it may be damaged or misnamed.</source>
   <translation>{0} gibt sich als {1} aus, ist es aber nach dem Inhalt nicht; die Datei ist vielleicht beschädigt oder falsch benannt.</translation>
  </message>
  <message>
   <source>{0} claims {1} bytes</source>
   <translation>{0} soll {1} Bytes haben</translation>
  </message>
  <message>
   <source>{0} defines XML entities of its own, which is refused: E57 has none.</source>
   <translation>{0} definiert eigene XML-Entitäten; das wird abgelehnt, denn E57 hat keine.</translation>
  </message>
  <message>
   <source>{0} depth images of {1} have no pose; they were left out.</source>
   <translation>{0} Tiefenbilder von {1} haben keine Pose; sie wurden weggelassen.</translation>
  </message>
  <message>
   <source>{0} depth images that {1} lists are not there; they were left out.</source>
   <translation>{0} Tiefenbilder, die {1} aufzählt, sind nicht da; sie wurden weggelassen.</translation>
  </message>
  <message>
   <source>{0} doors</source>
   <translation>{0} Türen</translation>
  </message>
  <message>
   <source>{0} failed: {1}: {2}.</source>
   <translation>{0} ist gescheitert: {1}: {2}.</translation>
  </message>
  <message>
   <source>{0} files are in {1}, but then no building is of this size.</source>
   <translation>{0}-Dateien haben {1}, aber so groß ist dann kein Gebäude.</translation>
  </message>
  <message>
   <source>{0} files are read as one survey: {1}.</source>
   <translation>{0} Dateien werden als eine Aufnahme gelesen: {1}.</translation>
  </message>
  <message>
   <source>{0} folder</source>
   <translation>{0}-Ordner</translation>
  </message>
  <message>
   <source>{0} has LAS point format {1}; known are 0 to 10.</source>
   <translation>{0} hat das LAS-Punktformat {1}; bekannt sind 0 bis 10.</translation>
  </message>
  <message>
   <source>{0} has a quaternion of length zero, which is no rotation.</source>
   <translation>{0} hat eine Quaternion der Länge null, die keine Drehung ist.</translation>
  </message>
  <message>
   <source>{0} has lists of differing lengths in its element {1}; write its points without list properties.</source>
   <translation>{0} hat im Element {1} Listen verschiedener Länge; die Punkte ohne Listen schreiben.</translation>
  </message>
  <message>
   <source>{0} has more than {1} pixels, too many for a map.</source>
   <translation>{0} hat mehr als {1} Pixel, zu viele für eine Karte.</translation>
  </message>
  <message>
   <source>{0} has no coordinates: its fields are {1}, not x, y, z.</source>
   <translation>{0} hat keine Koordinaten: Die Felder sind {1}, nicht x, y, z.</translation>
  </message>
  <message>
   <source>{0} has no coordinates: its points have {1}, not x, y, z.</source>
   <translation>{0} hat keine Koordinaten: Die Punkte haben {1}, nicht x, y, z.</translation>
  </message>
  <message>
   <source>{0} has no trajectory that could be corrected; leave drift.correct at false.</source>
   <translation>{0} hat keine Trajektorie, die sich korrigieren ließe; drift.correct auf false lassen.</translation>
  </message>
  <message>
   <source>{0} has no trajectory, so nobody knows when its points were seen; give one with --trajectory, or use 'floorcast plan'.</source>
   <translation>{0} hat keine Trajektorie, also weiß niemand, wann die Punkte gesehen wurden; mit --trajectory eine angeben oder 'floorcast plan' nutzen.</translation>
  </message>
  <message>
   <source>{0} has {1} columns instead of the 8 of TUM form (timestamp tx ty tz qx qy qz qw).</source>
   <translation>{0} hat {1} Spalten statt der 8 der TUM-Form (timestamp tx ty tz qx qy qz qw).</translation>
  </message>
  <message>
   <source>{0} has {1} points but {2} has the shape {3}.</source>
   <translation>{0} hat {1} Punkte, aber {2} hat die Form {3}.</translation>
  </message>
  <message>
   <source>{0} holds 0 points.</source>
   <translation>{0} enthält 0 Punkte.</translation>
  </message>
  <message>
   <source>{0} holds a value that is not a finite number.</source>
   <translation>{0} enthält einen Wert, der keine endliche Zahl ist.</translation>
  </message>
  <message>
   <source>{0} holds less than {1} m2 of free cells ({2} cells of {3} m); check the resolution, and negate and free_thresh of the map's YAML.</source>
   <translation>{0} enthält weniger als {1} m2 freie Zellen ({2} Zellen von {3} m); die Auflösung prüfen, ebenso negate und free_thresh in der YAML der Karte.</translation>
  </message>
  <message>
   <source>{0} holds no PointCloud2, LaserScan or depth image messages on the topic {1} (input.topic); its topics: {2}.</source>
   <translation>{0} enthält keine Nachrichten PointCloud2, LaserScan oder Tiefenbild auf dem Topic {1} (input.topic); Topics: {2}.</translation>
  </message>
  <message>
   <source>{0} holds no PointCloud2, LaserScan or depth image messages; its topics: {1}.</source>
   <translation>{0} enthält keine Nachrichten PointCloud2, LaserScan oder Tiefenbild; Topics: {1}.</translation>
  </message>
  <message>
   <source>{0} holds no array of points of shape (N, 3); its arrays: {1}.</source>
   <translation>{0} enthält kein Feld von Punkten der Form (N, 3); die Felder: {1}.</translation>
  </message>
  <message>
   <source>{0} holds no lines of three numbers or more.</source>
   <translation>{0} enthält keine Zeilen von drei oder mehr Zahlen.</translation>
  </message>
  <message>
   <source>{0} holds no point with finite coordinates of a plausible size.</source>
   <translation>{0} enthält keinen Punkt mit endlichen Koordinaten von glaubhafter Größe.</translation>
  </message>
  <message>
   <source>{0} holds no poses for the {1} scans in the frame {2} (no moving transform, no odometry); name a trajectory with --trajectory; its topics: {3}.</source>
   <translation>{0} enthält keine Posen zu den {1} Scans im System {2} (keine bewegte Transformation, keine Odometrie); mit --trajectory eine Trajektorie angeben; Topics: {3}.</translation>
  </message>
  <message>
   <source>{0} holds pickled objects ({1}), which are refused because reading them could run code; save plain arrays of numbers.</source>
   <translation>{0} enthält Python-Objekte (pickle: {1}), die abgelehnt werden, weil ihr Lesen Programmcode ausführen könnte; einfache Zahlenfelder speichern.</translation>
  </message>
  <message>
   <source>{0} holds the depth images {1} but no camera_info beside them, so their geometry is not known; camera_info topics: {2}.</source>
   <translation>{0} enthält die Tiefenbilder {1}, aber keine camera_info dazu, also ist ihre Geometrie nicht bekannt; Topics mit camera_info: {2}.</translation>
  </message>
  <message>
   <source>{0} holds {1} depth images ({2}); {3}.</source>
   <translation>{0} enthält {1} Tiefenbilder ({2}); {3}.</translation>
  </message>
  <message>
   <source>{0} holds {1} occupied and {2} free voxels of {3} m; its free space is used as it is.</source>
   <translation>{0} enthält {1} belegte und {2} freie Voxel von {3} m; der freie Raum wird genommen, wie er ist.</translation>
  </message>
  <message>
   <source>{0} holds {1} planar scans ({2}) with their poses.</source>
   <translation>{0} enthält {1} ebene Scans ({2}) mit ihren Posen.</translation>
  </message>
  <message>
   <source>{0} holds {1} scans, each in the frame of its sensor.</source>
   <translation>{0} enthält {1} Scans, jeden im System seines Sensors.</translation>
  </message>
  <message>
   <source>{0} holds {1} without scanner positions: where each point was seen from is not known.</source>
   <translation>{0} enthält {1} ohne Lage des Scanners: Von wo jeder Punkt gesehen wurde, ist nicht bekannt.</translation>
  </message>
  <message>
   <source>{0} holds {1}, each with the position of its scanner.</source>
   <translation>{0} enthält {1}, jeden mit der Lage seines Scanners.</translation>
  </message>
  <message>
   <source>{0} holds {1}; each was seen from the origin of its own frame.</source>
   <translation>{0} enthält {1}; jeder wurde vom Ursprung seines eigenen Systems aus gesehen.</translation>
  </message>
  <message>
   <source>{0} images that moved are read.</source>
   <translation>{0} Bilder mit Bewegung werden gelesen.</translation>
  </message>
  <message>
   <source>{0} images that moved are used.</source>
   <translation>{0} Bilder mit Bewegung werden genutzt.</translation>
  </message>
  <message>
   <source>{0} is E57 version {1}.{2}; readable is version 1.</source>
   <translation>{0} hat die E57-Version {1}.{2}; lesbar ist Version 1.</translation>
  </message>
  <message>
   <source>{0} is LAS 1.0 and says that its first point is two bytes before it is; convert it to LAS 1.2 or later.</source>
   <translation>{0} ist LAS 1.0 und nennt den ersten Punkt zwei Bytes zu früh; in LAS 1.2 oder neuer umwandeln.</translation>
  </message>
  <message>
   <source>{0} is LAS version {1}.{2}; readable are 1.0 to 1.4.</source>
   <translation>{0} hat die LAS-Version {1}.{2}; lesbar sind 1.0 bis 1.4.</translation>
  </message>
  <message>
   <source>{0} is a CARMEN log without scans that have poses (FLASER or ROBOTLASER1 messages).</source>
   <translation>{0} ist ein CARMEN-Protokoll ohne Scans mit Posen (Nachrichten FLASER oder ROBOTLASER1).</translation>
  </message>
  <message>
   <source>{0} is a LAS file of 0 points.</source>
   <translation>{0} ist eine LAS-Datei von 0 Punkten.</translation>
  </message>
  <message>
   <source>{0} is a PCD file of 0 points.</source>
   <translation>{0} ist eine PCD-Datei von 0 Punkten.</translation>
  </message>
  <message>
   <source>{0} is a PLY file of 0 points.</source>
   <translation>{0} ist eine PLY-Datei von 0 Punkten.</translation>
  </message>
  <message>
   <source>{0} is a PLY file without vertices (its elements: {1}).</source>
   <translation>{0} ist eine PLY-Datei ohne Punkte (ihre Elemente: {1}).</translation>
  </message>
  <message>
   <source>{0} is a PTX file without points.</source>
   <translation>{0} ist eine PTX-Datei ohne Punkte.</translation>
  </message>
  <message>
   <source>{0} is a bare image: {1} and more is free, 205 is unknown, all else is wall.</source>
   <translation>{0} ist ein bloßes Bild: {1} und mehr ist frei, 205 ist unbekannt, alles andere ist Wand.</translation>
  </message>
  <message>
   <source>{0} is a damaged map YAML: origin and thresholds must be finite numbers.</source>
   <translation>{0} ist eine beschädigte Karten-YAML: Ursprung und Schwellen müssen endliche Zahlen sein.</translation>
  </message>
  <message>
   <source>{0} is a damaged map YAML: {1}.</source>
   <translation>{0} ist eine beschädigte Karten-YAML: {1}.</translation>
  </message>
  <message>
   <source>{0} is a damaged project: {1}</source>
   <translation>{0} ist ein beschädigtes Projekt: {1}</translation>
  </message>
  <message>
   <source>{0} is a file; --follow is for a folder of scans that grows.</source>
   <translation>{0} ist eine Datei; --follow ist für einen Ordner von Scans, der wächst.</translation>
  </message>
  <message>
   <source>{0} is a glTF scene without meshes.</source>
   <translation>{0} ist eine glTF-Szene ohne Netze.</translation>
  </message>
  <message>
   <source>{0} is a mesh of {1} GB in a form that is loaded whole, which takes up to {2} GB of memory, and {3} GB are free; save it as binary STL or as binary PLY of triangles, which are read by pieces.</source>
   <translation>{0} ist ein Netz von {1} GB in einer Form, die im Ganzen geladen wird und bis zu {2} GB Speicher braucht, und {3} GB sind frei; als binäre STL oder binäre PLY aus Dreiecken speichern, die stückweise gelesen werden.</translation>
  </message>
  <message>
   <source>{0} is a mesh of {1} triangles and {2} m2; points on it are {3} m apart.</source>
   <translation>{0} ist ein Netz von {1} Dreiecken und {2} m2; die Punkte darauf liegen {3} m auseinander.</translation>
  </message>
  <message>
   <source>{0} is a mesh without any surface.</source>
   <translation>{0} ist ein Netz ohne jede Fläche.</translation>
  </message>
  <message>
   <source>{0} is a picture and has no scale; say how many metres a pixel is, like --resolution 0.05, or give the map's YAML file.</source>
   <translation>{0} ist ein Bild und hat keinen Maßstab; sagen, wie viele Meter ein Pixel ist, etwa --resolution 0.05, oder die YAML-Datei der Karte angeben.</translation>
  </message>
  <message>
   <source>{0} is a whole number, {1}; given {2}.</source>
   <translation>{0} ist eine ganze Zahl, {1}; gegeben ist {2}.</translation>
  </message>
  <message>
   <source>{0} is an E57 file without points.</source>
   <translation>{0} ist eine E57-Datei ohne Punkte.</translation>
  </message>
  <message>
   <source>{0} is an OctoMap of the kind {1}; readable are {2}.</source>
   <translation>{0} ist eine OctoMap der Art {1}; lesbar sind {2}.</translation>
  </message>
  <message>
   <source>{0} is an OctoMap without occupied voxels.</source>
   <translation>{0} ist eine OctoMap ohne belegte Voxel.</translation>
  </message>
  <message>
   <source>{0} is damaged ({1}: {2}).</source>
   <translation>{0} ist beschädigt ({1}: {2}).</translation>
  </message>
  <message>
   <source>{0} is damaged: a node of its glTF scene has two parents.</source>
   <translation>{0} ist beschädigt: Ein Knoten der glTF-Szene hat zwei Eltern.</translation>
  </message>
  <message>
   <source>{0} is damaged: a triangle refers to corner {1} of {2}.</source>
   <translation>{0} ist beschädigt: Ein Dreieck bezieht sich auf Ecke {1} von {2}.</translation>
  </message>
  <message>
   <source>{0} is damaged: it has a packet of points that cannot be one.</source>
   <translation>{0} ist beschädigt: Ein Paket von Punkten kann keines sein.</translation>
  </message>
  <message>
   <source>{0} is damaged: it is compressed and does not say how.</source>
   <translation>{0} ist beschädigt: Sie ist komprimiert und sagt nicht wie.</translation>
  </message>
  <message>
   <source>{0} is damaged: its E57 header points outside the file.</source>
   <translation>{0} ist beschädigt: Ihr E57-Kopf verweist auf Stellen außerhalb der Datei.</translation>
  </message>
  <message>
   <source>{0} is damaged: its LAZ chunk table announces {1} chunks.</source>
   <translation>{0} ist beschädigt: Die LAZ-Blocktabelle kündigt {1} Blöcke an.</translation>
  </message>
  <message>
   <source>{0} is damaged: its LAZ chunks hold {1} points each.</source>
   <translation>{0} ist beschädigt: Ihre LAZ-Blöcke enthalten je {1} Punkte.</translation>
  </message>
  <message>
   <source>{0} is damaged: its compressed points cannot be unpacked.</source>
   <translation>{0} ist beschädigt: Die komprimierten Punkte lassen sich nicht entpacken.</translation>
  </message>
  <message>
   <source>{0} is damaged: its compressed points take {1} bytes each, its header says {2}.</source>
   <translation>{0} ist beschädigt: Die komprimierten Punkte haben je {1} Bytes, der Kopf sagt {2}.</translation>
  </message>
  <message>
   <source>{0} is damaged: its glTF scene has {1} values without data.</source>
   <translation>{0} ist beschädigt: Die glTF-Szene hat {1} Werte ohne Daten.</translation>
  </message>
  <message>
   <source>{0} is damaged: its glTF scene is not as the format says.</source>
   <translation>{0} ist beschädigt: Die glTF-Szene ist nicht, wie das Format sagt.</translation>
  </message>
  <message>
   <source>{0} is damaged: its {1} points of {2} bytes do not agree with {3} bytes unpacked from {4}.</source>
   <translation>{0} ist beschädigt: {1} Punkte von {2} Bytes passen nicht zu {3} Bytes, entpackt aus {4}.</translation>
  </message>
  <message>
   <source>{0} is damaged: no points where its description puts them.</source>
   <translation>{0} ist beschädigt: Wo die Beschreibung Punkte angibt, sind keine.</translation>
  </message>
  <message>
   <source>{0} is damaged: page {1} has a wrong checksum.</source>
   <translation>{0} ist beschädigt: Seite {1} hat eine falsche Prüfsumme.</translation>
  </message>
  <message>
   <source>{0} is damaged: the description of its glTF scene is no JSON.</source>
   <translation>{0} ist beschädigt: Die Beschreibung der glTF-Szene ist kein JSON.</translation>
  </message>
  <message>
   <source>{0} is damaged: the description of its glTF scene is no object.</source>
   <translation>{0} ist beschädigt: Die Beschreibung der glTF-Szene ist kein Objekt.</translation>
  </message>
  <message>
   <source>{0} is damaged: the lines from byte {1} are no header of scan {2}.</source>
   <translation>{0} ist beschädigt: Die Zeilen ab Byte {1} sind kein Kopf von Scan {2}.</translation>
  </message>
  <message>
   <source>{0} is damaged: the sizes in its LAZ chunk table exceed the file.</source>
   <translation>{0} ist beschädigt: Die Größen in der LAZ-Blocktabelle übersteigen die Datei.</translation>
  </message>
  <message>
   <source>{0} is damaged: {1} cannot be unpacked.</source>
   <translation>{0} ist beschädigt: {1} lässt sich nicht entpacken.</translation>
  </message>
  <message>
   <source>{0} is empty.</source>
   <translation>{0} ist leer.</translation>
  </message>
  <message>
   <source>{0} is in the frame {1} and may hold it</source>
   <translation>{0} liegt im System {1} und enthält es vielleicht schon</translation>
  </message>
  <message>
   <source>{0} is named like a {1} file but holds {2}; it was read as that.</source>
   <translation>{0} heißt wie eine {1}-Datei, enthält aber {2}; so wurde sie gelesen.</translation>
  </message>
  <message>
   <source>{0} is no length; type one like 3.2, 320 cm or 10' 6".</source>
   <translation>{0} ist keine Länge; möglich ist etwa 3,2 oder 320 cm oder 10' 6".</translation>
  </message>
  <message>
   <source>{0} is no map YAML: it does not say {1}.</source>
   <translation>{0} ist keine Karten-YAML: {1} fehlt darin.</translation>
  </message>
  <message>
   <source>{0} is no {1} that can be read, or is damaged ({2}){3}.</source>
   <translation>{0} ist keine lesbare Datei der Art {1} oder ist beschädigt ({2}){3}.</translation>
  </message>
  <message>
   <source>{0} is not a KITTI scan: its {1} bytes are no whole number of points of 16 bytes.</source>
   <translation>{0} ist kein KITTI-Scan: {1} Bytes sind keine ganze Zahl von Punkten zu 16 Bytes.</translation>
  </message>
  <message>
   <source>{0} is not a list of actions ({1}).</source>
   <translation>{0} ist keine Liste von Befehlen ({1}).</translation>
  </message>
  <message>
   <source>{0} is not a list of actions like {"action": "file.open", "path": …}.</source>
   <translation>{0} ist keine Liste von Befehlen wie {"action": "file.open", "path": …}.</translation>
  </message>
  <message>
   <source>{0} is not a number</source>
   <translation>{0} ist keine Zahl</translation>
  </message>
  <message>
   <source>{0} is not a number of metres, like 3.412.</source>
   <translation>{0} ist keine Zahl von Metern wie 3.412.</translation>
  </message>
  <message>
   <source>{0} is not a point cloud that Floorcast knows; readable are: {1}.</source>
   <translation>{0} ist keine Punktwolke, die Floorcast kennt; lesbar sind: {1}.</translation>
  </message>
  <message>
   <source>{0} is not a row of numbers: {1}.</source>
   <translation>{0} ist keine Zeile von Zahlen: {1}.</translation>
  </message>
  <message>
   <source>{0} is not a trajectory: it is not text.</source>
   <translation>{0} ist keine Trajektorie: Es ist kein Text.</translation>
  </message>
  <message>
   <source>{0} is not a valid numpy file: its header is damaged.</source>
   <translation>{0} ist keine gültige numpy-Datei: Ihr Kopf ist beschädigt.</translation>
  </message>
  <message>
   <source>{0} is not an undamaged Floorcast project ({1}).</source>
   <translation>{0} ist kein unbeschädigtes Floorcast-Projekt ({1}).</translation>
  </message>
  <message>
   <source>{0} is not text.</source>
   <translation>{0} ist kein Text.</translation>
  </message>
  <message>
   <source>{0} is not the same as when this project was saved; check the corrections.</source>
   <translation>{0} ist nicht dieselbe wie beim Speichern dieses Projekts; die Korrekturen prüfen.</translation>
  </message>
  <message>
   <source>{0} is not where it was; say where it lies now.</source>
   <translation>{0} ist nicht mehr, wo es war; bitte sagen, wo es jetzt liegt.</translation>
  </message>
  <message>
   <source>{0} is not {1}: it lacks a name, a description or a method</source>
   <translation>{0} ist nicht {1}: Name, Beschreibung oder eine Methode fehlt</translation>
  </message>
  <message>
   <source>{0} is one of {1}, not {2}.</source>
   <translation>{0} ist eins von {1}, nicht {2}.</translation>
  </message>
  <message>
   <source>{0} is read like the other {1} files: in {2}, {3} up.</source>
   <translation>{0} wird gelesen wie die anderen Dateien ({1}): in {2}, {3} nach oben.</translation>
  </message>
  <message>
   <source>{0} is too large for a text of poses ({1} bytes).</source>
   <translation>{0} ist zu groß für einen Text von Posen ({1} Bytes).</translation>
  </message>
  <message>
   <source>{0} is too large for a trajectory ({1} bytes).</source>
   <translation>{0} ist zu groß für eine Trajektorie ({1} Bytes).</translation>
  </message>
  <message>
   <source>{0} is truncated inside its E57 header ({1} bytes).</source>
   <translation>{0} ist im E57-Kopf abgeschnitten ({1} Bytes).</translation>
  </message>
  <message>
   <source>{0} is truncated inside its LAS header ({1} bytes).</source>
   <translation>{0} ist im LAS-Kopf abgeschnitten ({1} Bytes).</translation>
  </message>
  <message>
   <source>{0} is truncated or damaged: its LAZ chunk table is missing.</source>
   <translation>{0} ist abgeschnitten oder beschädigt: Die LAZ-Blocktabelle fehlt.</translation>
  </message>
  <message>
   <source>{0} is truncated or damaged: its glTF header says {1} bytes.</source>
   <translation>{0} ist abgeschnitten oder beschädigt: Der glTF-Kopf sagt {1} Bytes.</translation>
  </message>
  <message>
   <source>{0} is truncated or damaged: its header puts the first point at byte {1} after {2} records, the file has {3} bytes.</source>
   <translation>{0} ist abgeschnitten oder beschädigt: Nach dem Kopf beginnt der erste Punkt bei Byte {1} nach {2} Einträgen, die Datei hat {3} Bytes.</translation>
  </message>
  <message>
   <source>{0} is truncated or damaged: its header says {1} bytes, it has {2}.</source>
   <translation>{0} ist abgeschnitten oder beschädigt: Der Kopf sagt {1} Bytes, es sind {2}.</translation>
  </message>
  <message>
   <source>{0} is truncated or damaged: the lists of its element {1} do not fit into its {2} bytes.</source>
   <translation>{0} ist abgeschnitten oder beschädigt: Die Listen des Elements {1} passen nicht in seine {2} Bytes.</translation>
  </message>
  <message>
   <source>{0} is truncated or damaged: {1}.</source>
   <translation>{0} ist abgeschnitten oder beschädigt: {1}.</translation>
  </message>
  <message>
   <source>{0} is truncated: its array {1} should have the shape {2}, the file holds less; copy it again.</source>
   <translation>{0} ist abgeschnitten: Das Feld {1} sollte die Form {2} haben, die Datei enthält weniger; noch einmal kopieren.</translation>
  </message>
  <message>
   <source>{0} is truncated: its header promises at least {1} bytes of elements, {2} follow it.</source>
   <translation>{0} ist abgeschnitten: Der Kopf verspricht mindestens {1} Bytes an Elementen, {2} folgen ihm.</translation>
  </message>
  <message>
   <source>{0} is truncated: its header promises {1} points, its {2} chunks hold fewer.</source>
   <translation>{0} ist abgeschnitten: Der Kopf verspricht {1} Punkte, die {2} Blöcke enthalten weniger.</translation>
  </message>
  <message>
   <source>{0} is truncated: its header promises {1} points, the file has lines for {2} of them; copy it again.</source>
   <translation>{0} ist abgeschnitten: Der Kopf verspricht {1} Punkte, die Datei hat Zeilen für {2} davon; noch einmal kopieren.</translation>
  </message>
  <message>
   <source>{0} is truncated: its header promises {1} points, the file holds {2} of them; copy it again.</source>
   <translation>{0} ist abgeschnitten: Der Kopf verspricht {1} Punkte, die Datei enthält {2} davon; noch einmal kopieren.</translation>
  </message>
  <message>
   <source>{0} is truncated: its header promises {1} points, {2} of them exist.</source>
   <translation>{0} ist abgeschnitten: Der Kopf verspricht {1} Punkte, {2} davon sind da.</translation>
  </message>
  <message>
   <source>{0} is truncated: its header promises {1} triangles, {2} of them exist.</source>
   <translation>{0} ist abgeschnitten: Der Kopf verspricht {1} Dreiecke, {2} davon sind da.</translation>
  </message>
  <message>
   <source>{0} is truncated: scan {1} promises {2} points, {3} of them exist.</source>
   <translation>{0} ist abgeschnitten: Scan {1} verspricht {2} Punkte, {3} davon sind da.</translation>
  </message>
  <message>
   <source>{0} is truncated: {1} bytes of compressed points are promised, {2} are there; copy it again.</source>
   <translation>{0} ist abgeschnitten: {1} Bytes komprimierter Punkte sind versprochen, {2} sind da; noch einmal kopieren.</translation>
  </message>
  <message>
   <source>{0} is truncated: {1} of the {2} points of a scan do not exist.</source>
   <translation>{0} ist abgeschnitten: {1} der {2} Punkte eines Scans fehlen.</translation>
  </message>
  <message>
   <source>{0} is {1}; readable are: {2}.</source>
   <translation>{0} ist {1}; lesbar sind: {2}.</translation>
  </message>
  <message>
   <source>{0} lines of {1} are damaged scans; they were left out.</source>
   <translation>{0} Zeilen von {1} sind beschädigte Scans; sie wurden weggelassen.</translation>
  </message>
  <message>
   <source>{0} lines of {1} hold no point; they were left out.</source>
   <translation>{0} Zeilen von {1} enthalten keinen Punkt; sie wurden weggelassen.</translation>
  </message>
  <message>
   <source>{0} lists voxels of {1} m that fill space, like the free space of a map, and a plan needs surfaces: open the map itself (an OctoMap .bt or .ot has both) or its occupied voxels.</source>
   <translation>{0} zählt Voxel von {1} m auf, die den Raum füllen, wie der freie Raum einer Karte, und ein Plan braucht Oberflächen: Öffnen Sie die Karte selbst (eine OctoMap .bt oder .ot hat beides) oder ihre belegten Voxel.</translation>
  </message>
  <message>
   <source>{0} m is out of bounds</source>
   <translation>{0} m liegt außerhalb der Grenzen</translation>
  </message>
  <message>
   <source>{0} m2 of free space are in no region: no rectangle of walls encloses them.</source>
   <translation>{0} m² freier Raum liegen in keiner Region: Kein Rechteck von Wänden schließt sie ein.</translation>
  </message>
  <message>
   <source>{0} m2 of wall ({1} of all) stand at other angles than the plan, and no rooms follow them: they come out as steps or are missing.</source>
   <translation>{0} m2 Wand ({1} von allen) stehen in anderen Winkeln als der Plan, und keine Räume folgen ihnen: sie erscheinen als Stufen oder fehlen.</translation>
  </message>
  <message>
   <source>{0} mesh</source>
   <translation>{0}-Netz</translation>
  </message>
  <message>
   <source>{0} names an image outside its own folder ({1}), which is refused; put it beside the YAML file and write its name only.</source>
   <translation>{0} nennt ein Bild außerhalb des eigenen Ordners ({1}), was abgelehnt wird; es neben die YAML-Datei legen und nur seinen Namen schreiben.</translation>
  </message>
  <message>
   <source>{0} needs a window.</source>
   <translation>{0} braucht ein Fenster.</translation>
  </message>
  <message>
   <source>{0} of the {1} points of {2} are classified as noise or withheld; they were left out.</source>
   <translation>{0} der {1} Punkte von {2} sind als Rauschen oder zurückgehalten eingestuft; sie wurden weggelassen.</translation>
  </message>
  <message>
   <source>{0} of the {1} points of {2} are more than {3} s from any row of the trajectory; they were left out.</source>
   <translation>{0} der {1} Punkte von {2} sind mehr als {3} s von jeder Zeile der Trajektorie entfernt; sie wurden weggelassen.</translation>
  </message>
  <message>
   <source>{0} of the {1} points of {2} are not finite or absurdly far away; they were left out.</source>
   <translation>{0} der {1} Punkte von {2} sind nicht endlich oder unsinnig weit weg; sie wurden weggelassen.</translation>
  </message>
  <message>
   <source>{0} of the {1} scans of {2} have no pose; they were left out.</source>
   <translation>{0} der {1} Scans von {2} haben keine Pose; sie wurden weggelassen.</translation>
  </message>
  <message>
   <source>{0} of them have no sensor positions: there free space is told by the others only.</source>
   <translation>{0} davon haben keine Sensorlagen: Dort zeigen nur die anderen den freien Raum.</translation>
  </message>
  <message>
   <source>{0} of {1} regions have walls at other angles; their outline is the map's own, not made of layout planes.</source>
   <translation>{0} von {1} Regionen haben Wände unter anderen Winkeln; ihr Umriss ist der der Karte, nicht aus Wandebenen gebildet.</translation>
  </message>
  <message>
   <source>{0} passages in walls at other angles part regions but are not drawn as doors.</source>
   <translation>{0} Durchgänge in Wänden unter anderen Winkeln trennen Regionen, sind aber nicht als Türen gezeichnet.</translation>
  </message>
  <message>
   <source>{0} rectangles fit between the {1} planes that face east, west, north and south, more than the {2} of candidates.max_count; raise planes.min_support or lower candidates.max_ratio.</source>
   <translation>{0} Rechtecke passen zwischen die {1} Ebenen nach Osten, Westen, Norden und Süden, mehr als die {2} von candidates.max_count; planes.min_support erhöhen oder candidates.max_ratio senken.</translation>
  </message>
  <message>
   <source>{0} regions</source>
   <translation>{0} Regionen</translation>
  </message>
  <message>
   <source>{0} says that its points take {1} bytes each; it is damaged.</source>
   <translation>{0} gibt für jeden Punkt {1} Bytes an; die Datei ist beschädigt.</translation>
  </message>
  <message>
   <source>{0} scan</source>
   <translation>{0} Scan</translation>
  </message>
  <message>
   <source>{0} scans</source>
   <translation>{0} Scans</translation>
  </message>
  <message>
   <source>{0} takes about {1} MB more memory, and {2} MB are free; enlarge voxels.size (twice the size takes a quarter), crop the survey, or end other programs.</source>
   <translation>{0} braucht etwa {1} MB Speicher mehr, und {2} MB sind frei; voxels.size vergrößern (doppelte Größe braucht ein Viertel), die Aufnahme zuschneiden oder andere Programme beenden.</translation>
  </message>
  <message>
   <source>{0} triangles with corners absurdly far away were left out.</source>
   <translation>{0} Dreiecke mit unsinnig weit entfernten Ecken wurden weggelassen.</translation>
  </message>
  <message>
   <source>{0} unpacks to more than {1} bytes, which no log does.</source>
   <translation>{0} ergibt entpackt mehr als {1} Bytes, wie es kein Protokoll tut.</translation>
  </message>
  <message>
   <source>{0} walls</source>
   <translation>{0} Wände</translation>
  </message>
  <message>
   <source>{0} was not written.</source>
   <translation>{0} wurde nicht geschrieben.</translation>
  </message>
  <message>
   <source>{0} was refused: {1} unpacks from {2} to {3} bytes, which no point cloud does.</source>
   <translation>{0} wurde abgelehnt: {1} entpackt sich von {2} auf {3} Bytes, wie es keine Punktwolke tut.</translation>
  </message>
  <message>
   <source>{0}, all within {1} m of height; a 2-D scan shows walls only with its trajectory.</source>
   <translation>{0}, alle innerhalb von {1} m Höhe; ein 2D-Scan zeigt Wände nur mit seiner Trajektorie.</translation>
  </message>
  <message>
   <source>{0}, as is usual: no images show so much of the same surfaces that it can be checked.</source>
   <translation>{0}, wie üblich: Keine Bilder zeigen so viel derselben Flächen, dass es sich prüfen lässt.</translation>
  </message>
  <message>
   <source>{0}, {1} m wide, {2} sure</source>
   <translation>{0}, {1} m breit, {2} sicher</translation>
  </message>
  <message>
   <source>{0}, {1} wide, {2} sure</source>
   <translation>{0}, {1} breit, {2} sicher</translation>
  </message>
  <message>
   <source>{0}: give it as an argument; a script has nobody to ask.</source>
   <translation>{0}: als Argument angeben; ein Skript kann niemanden fragen.</translation>
  </message>
  <message>
   <source>{0}: give it as an argument; there is nobody to ask.</source>
   <translation>{0}: bitte als Argument angeben; es ist niemand zu fragen.</translation>
  </message>
  <message>
   <source>{0}: give the path as an argument; there is nobody to ask.</source>
   <translation>{0}: den Pfad als Argument angeben; es ist niemand zu fragen.</translation>
  </message>
  <message>
   <source>{0}: so {1} of what one image shows is where another shows it.</source>
   <translation>{0}: So liegt {1} dessen, was ein Bild zeigt, da, wo ein anderes es zeigt.</translation>
  </message>
  <message>
   <source>{0}: {1} {2} messages of the topic {3} are read.</source>
   <translation>{0}: {1} Nachrichten ({2}) des Topics {3} werden gelesen.</translation>
  </message>
  <message>
   <source>{0}; check the unit and the up axis (--set input.unit=... or input.up=...), or scan more walls.</source>
   <translation>{0}; Einheit und Hochachse prüfen (--set input.unit=... oder input.up=...) oder mehr Wände scannen.</translation>
  </message>
  <message>
   <source>{free} free of {total}</source>
   <translation>{free} frei von {total}</translation>
  </message>
  <message>
   <source>{low} to {high}</source>
   <translation>{low} bis {high}</translation>
  </message>
  <message>
   <source>{name} is not where it was, in {folder}. Corrections and checks wait until it is found.</source>
   <translation>{name} ist nicht mehr in {folder}. Korrekturen und Kontrollmaße warten, bis sie gefunden ist.</translation>
  </message>
  <message>
   <source>{n} of {total}</source>
   <translation>{n} von {total}</translation>
  </message>
  <message>
   <source>{n}, of them 1 room</source>
   <translation>{n}, davon 1 Raum</translation>
  </message>
  <message>
   <source>{n}, of them {rooms} rooms</source>
   <translation>{n}, davon {rooms} Räume</translation>
  </message>
  <message>
   <source>{share} sure</source>
   <translation>{share} sicher</translation>
  </message>
  <message>
   <source>{time} left</source>
   <translation>noch {time}</translation>
  </message>
 </context>
</TS>
